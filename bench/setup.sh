#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-only
# Installs the Debian packages that bwfirt is built, run and tested with. Quick and silent where
# nothing is missing. Works as root and, elsewhere, with sudo.
set -eu

packages='
    g++ clang lld libclang-rt-dev libomp-dev scons git
    libimath-dev libopenexr-dev libpng-dev libxxhash-dev libcli11-dev nlohmann-json3-dev
    libassimp-dev libgtest-dev libembree-dev
    libsdl2-dev libsdl2-ttf-dev libfontconfig-dev fonts-dejavu-core xvfb xdotool openbox
    python3-numpy python3-pytest
    chromium chromium-driver python3-selenium
    python3-matplotlib python3-jinja2 python3-tqdm python3-imageio libfreeimage3
    texlive-latex-base texlive-latex-recommended texlive-font-utils ghostscript lmodern
    poppler-utils
'

missing=
for package in $packages; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) || status=
    [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
        echo "setup.sh: neither root nor sudo: install$missing" >&2
        exit 1
    }
    as_root=sudo
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "setup.sh: installing$missing"
{
    $as_root apt-get update -q &&
        $as_root env DEBIAN_FRONTEND=noninteractive \
            apt-get install -q -y --no-install-recommends $missing
} >"$log" 2>&1 || {
    cat "$log" >&2
    echo "setup.sh: could not install$missing" >&2
    exit 1
}
