# SPDX-License-Identifier: GPL-3.0-only
"""What is measured: scenes, kernels, and the runs that a benchmark consists of."""

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RECORDER = 'simple-bvh'  # its answers and its image are those that others are compared with
TEMPLATE = 'yourkernel'
WORD = re.compile(r'#.*|"([^"\n]*)"|([^\s#]+)')  # of a scene file, as doc/file-formats says
RENDER, CONTROL, RECORD, REPLAY = 'render', 'control', 'record', 'replay'


class UsageError(Exception):
    """A name or a value on the command line that fits nothing."""


@dataclass(frozen=True)
class Extent:
    """How much is measured."""

    size: str  # of the image, WIDTHxHEIGHT in pixels
    passes: int  # samples per pixel
    repeats: int
    controls: int | None  # the first scenes, so many, have a control; None: all
    replay_rays: int  # at least so many questions are recorded of each scene
    replay_seconds: float  # the shortest time of one measurement of a replay
    replays_on_one_thread: bool  # whether kernels replay on one thread, too
    growth: tuple[int, ...]  # triangles, about
    time_limit: float  # of one run, in seconds


@dataclass(frozen=True)
class Scene:
    """A scene file and the camera of the same name beside it."""

    name: str
    file: Path
    camera: Path
    scale: int | None = None  # triangles, about, where it is made for a growth curve

    @property
    def triangles(self) -> Path:
        """The triangle file that the scene file names; the latter itself where it names none."""
        try:
            text = self.file.read_text(encoding='utf-8', errors='surrogateescape')
        except OSError:
            return self.file
        words = [quoted or word for quoted, word in WORD.findall(text) if quoted or word]
        named = [path for key, path in zip(words, words[1:]) if key == 'triangles']
        return self.file.parent / named[0] if named else self.file


@dataclass(frozen=True)
class Kernel:
    """An executable bwfirt-NAME with options of the kernel."""

    name: str  # NAME or NAME:OPTION=VALUE,...
    program: Path

    @property
    def options(self) -> list[str]:
        _, _, options = self.name.partition(':')
        return options.split(',') if options else []


@dataclass(frozen=True)
class Run:
    """One process that is to be measured."""

    kind: str  # RENDER, CONTROL (the same again, to learn the noise), RECORD or REPLAY
    scene: Scene
    kernel: Kernel
    threads: int
    repeat: int = 1

    @property
    def name(self) -> str:
        """The path of its results below the folder of results, without an ending."""
        kernel = self.kernel.name.replace('/', '%')  # its options may name a file
        folder = f'{self.scene.name}/{kernel}'
        if self.kind == RECORD:
            return f'{folder}/{RECORD}'
        return f'{folder}/{self.kind}-{self.threads}-threads-{self.repeat}'


def unique(name: str, taken: Iterable[str]) -> str:
    names = [name, *(f'{name}-{number}' for number in range(2, 1000))]
    return next(candidate for candidate in names if candidate not in taken)


def scene_files(entry: str) -> list[Path]:
    """The files of an entry: NAME in scenes/, a scene file, or a folder of scenes with cameras."""
    entry = os.path.expandvars(entry)
    if entry.startswith('$'):  # an environment variable that is not set
        return []
    path = Path(entry)
    if path.is_dir():
        return sorted(file for file in path.glob('*.scene') if file.with_suffix('.camera').exists())
    if path.suffix == '.scene':
        return [path.absolute()]
    return [ROOT / 'scenes' / f'{entry}.scene']


def find_scenes(entries: Iterable[str]) -> list[Scene]:
    """Two files of one name become NAME and NAME-2.

    @throws UsageError for a scene that does not exist
    """
    scenes: dict[str, Scene] = {}
    for entry in entries:
        for file in scene_files(entry):
            if not file.exists():
                made = (ROOT / 'scenes' / f'{entry}.py').exists()
                raise UsageError(f'{file} does not exist' + ': run `scons scenes`' * made)
            camera = file.with_suffix('.camera')
            if not camera.exists():
                raise UsageError(f'{camera} does not exist: a scene needs a camera beside it')
            name = unique(file.stem, scenes)
            scenes[name] = Scene(name, file, camera)
    if not scenes:
        raise UsageError('there is no scene to measure')
    return list(scenes.values())


def built_kernels(build: Path) -> list[str]:
    return sorted(program.name.removeprefix('bwfirt-') for program in build.glob('bwfirt-*')
                  if program.name != 'bwfirt-import' and program.is_file()
                  and os.access(program, os.X_OK))


def find_kernels(entries: Iterable[str], build: Path) -> list[Kernel]:
    """'*' stands for all that are built and not named otherwise, but for the template.

    @throws UsageError for a kernel that is not built
    """
    built = built_kernels(build)
    entries = list(entries)
    named = {entry.partition(':')[0] for entry in entries}
    kernels: dict[str, Kernel] = {}
    for entry in entries:
        others = [name for name in built if name not in named | {TEMPLATE}]
        for name in others if entry == '*' else [entry]:
            base = name.partition(':')[0]
            if base not in built:
                raise UsageError(f"the kernel '{base}' is not built in {build}; built are: "
                                 f"{', '.join(built) or 'none'}")
            kernels[name] = Kernel(name, build / f'bwfirt-{base}')
    if not kernels:
        raise UsageError(f'there is no kernel to measure in {build}')
    return list(kernels.values())


def thread_counts(threads: int) -> list[int]:
    """1, 2, 4 ... and the number itself."""
    return sorted({2**power for power in range(threads.bit_length())} | {threads})


def in_turn(runs: list[Run]) -> list[Run]:
    """Runs of one repeat. Each repeat begins with another one, so that none always comes first."""
    first = (runs[0].repeat - 1) % len(runs)
    return runs[first:] + runs[:first]


@dataclass(frozen=True)
class Plan:
    """All runs of a benchmark."""

    scenes: list[Scene]
    kernels: list[Kernel]
    control: str  # the kernel that is measured against itself
    growth: list[Scene]
    scaling: list[str]  # scenes that are rendered with fewer threads, too
    threads: int
    extent: Extent
    recorder: Kernel | None  # None where it is not built: there are no replays then

    def names(self) -> set[tuple[str, str]]:
        """Of scene and kernel."""
        return {(run.scene.name, run.kernel.name) for run in self.runs()}

    def runs(self) -> Iterator[Run]:
        """In the order in which they are made: within each repeat the kernels take turns."""
        for repeat in range(1, self.extent.repeats + 1):
            for scene in self.scenes:
                yield from self._renders(scene, repeat)
                yield from self._replays(scene, repeat)
            for scene in self.growth:
                yield from in_turn([Run(RENDER, scene, kernel, self.threads, repeat)
                                    for kernel in self.kernels])

    def _renders(self, scene: Scene, repeat: int) -> Iterator[Run]:
        runs = [Run(RENDER, scene, kernel, self.threads, repeat) for kernel in self.kernels]
        runs += [Run(CONTROL, scene, kernel, self.threads, repeat) for kernel in self.kernels
                 if kernel.name == self.control and scene in self.scenes[:self.extent.controls]]
        yield from in_turn(runs)
        if scene.name in self.scaling:
            for threads in thread_counts(self.threads)[:-1]:
                yield from in_turn([Run(RENDER, scene, kernel, threads, repeat)
                                    for kernel in self.kernels])

    def _replays(self, scene: Scene, repeat: int) -> Iterator[Run]:
        if self.recorder:
            if repeat == 1:
                yield Run(RECORD, scene, self.recorder, 1)
            counts = {self.threads, 1} if self.extent.replays_on_one_thread else {self.threads}
            for threads in sorted(counts):
                yield from in_turn([Run(REPLAY, scene, kernel, threads, repeat)
                                    for kernel in self.kernels])
