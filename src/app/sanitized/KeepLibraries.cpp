// SPDX-License-Identifier: GPL-3.0-only

/// Replaces the function of the C library in builds with the address sanitizer. SDL closes libraries
/// that hold memory till the end of the program; closed, they could no longer tell of it, and it
/// would look like a leak.
extern "C" int dlclose(void*) {
    return 0;
}
