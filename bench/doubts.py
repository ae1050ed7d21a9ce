# SPDX-License-Identifier: GPL-3.0-only
"""What makes the figures of a benchmark doubtful."""

from collections.abc import Callable, Iterator

from metrics import RATE, WRONG_ANSWERS, Measured
from plan import CONTROL, RENDER, REPLAY

ENOUGH_REPEATS = 3
WIDE_SPREAD = 0.1  # (highest - lowest) / median
BUSY = 0.05  # share of the machine's processor time that others take
TOLERATED_STEAL = 0.01
SHORT_REPLAY = 1  # second
SHORT_RENDERING = 1  # second


def percent(share: float) -> str:
    return f'{100 * share:.3g} %'


def missing_control(measured: Measured) -> Iterator[str]:
    if measured.noise(RATE) is None:
        yield ('There is no control: the noise is not known, and differences may be noise wherever '
               'ranges are narrow.')


def few_repeats(measured: Measured) -> Iterator[str]:
    fewest = min((len(runs) for scene in measured.scenes for kernel in measured.kernels
                  if measured.spread(RATE, scene, kernel)
                  and (runs := measured.runs(scene, kernel))), default=0)
    if 0 < fewest < ENOUGH_REPEATS:
        yield (f'Too few repeats: {fewest} for some kernel and scene, fewer than {ENOUGH_REPEATS}. '
               'Medians and ranges of so few mean little.')


def wide_spread(measured: Measured) -> Iterator[str]:
    ranges = {f'{kernel} on {scene}': spread.relative_range
              for scene in measured.scenes for kernel in measured.kernels
              if (spread := measured.spread(RATE, scene, kernel))}
    wide = {name: width for name, width in ranges.items() if width > WIDE_SPREAD}
    if wide:
        widest = max(wide, key=lambda name: wide[name])
        yield (f'Wide spread: the rays per second of {len(wide)} of {len(ranges)} pairs of kernel '
               f'and scene vary by more than {percent(WIDE_SPREAD)} of their median; most those of '
               f'{widest}, by {percent(wide[widest])}.')


def load(measured: Measured) -> Iterator[str]:
    runs = [result for result in measured.results if result.kind in (RENDER, CONTROL, REPLAY)]
    for key, limit, what in [
            ('others', BUSY, 'other processes took'),
            ('stolen', TOLERATED_STEAL, 'other virtual machines took (steal time)')]:
        shares = [result.bench['disturbance'][key] for result in runs]
        disturbed = [share for share in shares if share > limit]
        if disturbed:
            yield (f'The machine was not quiet: in {len(disturbed)} of {len(shares)} runs {what} '
                   f'more than {percent(limit)} of its processor time, at most '
                   f'{percent(max(disturbed))}.')


def machine(measured: Measured) -> Iterator[str]:
    machines = [result.bench['machine'] for result in measured.results]
    if any(one['virtual'] for one in machines):
        yield ('Measured in a virtual machine: what its host does meanwhile cannot be seen, and '
               'the clock of the processor neither.')
    governors = {one['governor'] for one in machines} - {'', 'performance'}
    if governors:
        yield f"The scaling governor is {', '.join(sorted(governors))}, not performance."
    if any(one['boost'] == 'on' for one in machines):
        yield 'Boost is on: the clock of the processor depends on temperature and on other cores.'
    if len({(one['cpu'], tuple(one['affinity'])) for one in machines}) > 1:
        yield 'The runs were made on different processors.'


def sessions(measured: Measured) -> Iterator[str]:
    for scene in measured.scenes:
        times = {result.bench['session'] for kernel in measured.kernels
                 for result in measured.runs(scene, kernel) + measured.replays(scene, kernel)}
        if len(times) > 1:
            yield (f'Measured in {len(times)} sessions, between {min(times)} and {max(times)}, '
                   f'{scene} among others: the machine may have changed in between.')
            return


def builds(measured: Measured) -> Iterator[str]:
    programs = [result.report['program'] for result in measured.results if result.done]
    if any('-O0' in program['flags'] or 'sanitize' in program['flags'] for program in programs):
        yield 'A debug build, or one with sanitizers, was measured.'
    for key, what in [('flags', 'The framework was compiled with different flags for the kernels.'),
                      ('kernel_flags', 'Kernels were compiled with different flags: see the table '
                                       'of compilers.'),
                      ('compiler', 'Different compilers were used.'),
                      ('commit', 'The kernels are of different commits.')]:
        if len({program[key] for program in programs}) > 1:
            yield what
    if any(program['commit'].endswith('-dirty') for program in programs):
        yield 'The sources were not those of a commit: nobody else can build the same programs.'


def extent(measured: Measured) -> Iterator[str]:
    done = [result for result in measured.results if result.done]
    for key in ['size', 'passes', 'threads', 'replay_rays', 'replay_seconds']:
        if len({result.fingerprint[key] for result in done if key in result.fingerprint}) > 1:
            yield f"The runs differ in {key.replace('_', ' ')}."
    if any(result.fingerprint['replay_seconds'] < SHORT_REPLAY for result in done
           if result.kind == REPLAY):
        yield ('Quick replays: their rates were timed over less than a second at a time, and are '
               'for a first look only.')
    times = [result.report['time']['render_s'] for scene in measured.scenes
             for kernel in measured.kernels if (result := measured.first(scene, kernel))]
    short = [time for time in times if time < SHORT_RENDERING]
    if short:
        yield (f'Short runs: {len(short)} of {len(times)} pairs of kernel and scene rendered for '
               f'less than {SHORT_RENDERING} s.')


def answers(measured: Measured) -> Iterator[str]:
    for kernel in measured.kernels:
        unchecked = [scene for scene in measured.scenes if measured.first(scene, kernel)
                     and measured.wrong_per_million(scene, kernel) is None]
        if unchecked:
            yield f"The answers of {kernel} were not checked on {', '.join(unchecked)}."
        for scene in measured.scenes:
            averages = {tuple(result.report['average_intensity']) for result in measured.results
                        if (result.scene, result.kernel) == (scene, kernel) and result.done
                        and result.kind in (RENDER, CONTROL)}
            if len(averages) > 1:
                yield (f'{kernel} answers differently from run to run on {scene}: its images of '
                       'the same seed are not the same.')


def leaks(measured: Measured) -> Iterator[str]:
    for kernel in measured.kernels:
        most = max((result.report['memory']['kernel_leaked_bytes'] for result in measured.results
                    if result.kernel == kernel and result.done), default=0)
        if most > 0:
            yield f'{kernel} leaked memory: up to {most} bytes in a run.'


def kernel_warnings(measured: Measured) -> Iterator[str]:
    """What the run reports warn of, each sentence once, but for what is told otherwise."""
    told = ['the rays were recorded meanwhile', 'answers differ from', 'rates measured for',
            'the kernel leaked']
    scenes: dict[tuple[str, str], list[str]] = {}
    for result in measured.results:
        for warning in result.report.get('warnings', []):
            if not any(warning.startswith(words) for words in told):
                names = scenes.setdefault((result.kernel, warning), [])
                if result.scene not in names:
                    names.append(result.scene)
    for (kernel, warning), names in scenes.items():
        yield f"{kernel} on {', '.join(names)}: {warning}."


CHECKS: list[Callable[[Measured], Iterator[str]]] = [
    missing_control, few_repeats, wide_spread, load, machine, sessions, builds, extent, answers,
    leaks, kernel_warnings]


def doubts(measured: Measured) -> list[str]:
    """One sentence for each thing that makes the figures doubtful."""
    return [sentence for check in CHECKS for sentence in check(measured)]


def failures(measured: Measured) -> list[tuple[str, str, str, str]]:
    """Scene, kernel, how it failed, and what it said; wrong answers are a failure, too."""
    rows = [(result.scene, result.kernel, f'{result.kind}: {result.status}', result.message)
            for result in measured.results if not result.done]
    for scene in measured.scenes:
        for kernel in measured.kernels:
            if measured.wrong_per_million(scene, kernel):
                replay = measured.worst_replay(scene, kernel)
                assert replay
                counts = replay.report['replay']['answers']
                rows.append((scene, kernel, 'wrong answers', ', '.join(
                    f"{counts[name]} {name.replace('_', ' ')}" for name in WRONG_ANSWERS
                    if counts[name]) + f" of {sum(replay.report['replay']['rays'].values())}"))
    return list(dict.fromkeys(rows))
