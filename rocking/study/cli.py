"""The `rocking` command: few verbs, each one call of the same functions as the workflow.

Each verb imports what it calls, so that help and refusals come at once.
"""

import argparse
import contextlib
import io
import sys
import warnings
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from shlex import quote
from typing import Any, TextIO

from rocking.errors import CatalogueError, ConfigurationError, RockingError, UnknownFormatError
from rocking.quantities import GRAVITY, escaped
from rocking.records.doors import through
from rocking.study import close_doors
from rocking.study.products import PRODUCTS


class _Escaped(io.TextIOBase):
    """A stream to a terminal, on which the name of a file or a folder can say nothing to the terminal itself.

    Letters that its encoding lacks are written as escape sequences. What goes to a stream that is closed is lost.
    """

    def __init__(self, stream: TextIO | None) -> None:
        self._stream = io.StringIO() if stream is None else stream

    def write(self, text: str) -> int:
        encoding = self._stream.encoding or "utf-8"
        return self._stream.write(escaped(text).encode(encoding, "backslashreplace").decode(encoding))

    def flush(self) -> None:
        self._stream.flush()

    def isatty(self) -> bool:
        return self._stream.isatty()

    @property
    def closed(self) -> bool:
        """Whether the stream is closed, which those ask who write at the very end of the process."""
        return self._stream.closed

    def fileno(self) -> int:
        return self._stream.fileno()


_MOST_LINES = 40
"""Lines of an error, of which each names one defect; more would push the first ones off the screen."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    0: all went well. 1: a record or a run failed. 2: what was asked for is wrong, such as a setting; it says why.
    130: it was stopped by Ctrl-C, 128 and the number of the signal in general.
    """
    plain = _Escaped(sys.stdout), _Escaped(sys.stderr)
    with contextlib.redirect_stdout(plain[0]), contextlib.redirect_stderr(plain[1]):
        options = _parsed(arguments)
        try:
            with warnings.catch_warnings():
                warnings.showwarning = _show
                close_doors()
                with through("command"):
                    return options.run(options) or 0
        except RockingError as error:
            lines = f"rocking: {error}".splitlines()
            print(*lines[:_MOST_LINES], sep="\n", file=sys.stderr)
            if len(lines) > _MOST_LINES:
                print(f"and {len(lines) - _MOST_LINES} lines more", file=sys.stderr)
            return 2 if isinstance(error, ConfigurationError | CatalogueError) else 1
        except KeyboardInterrupt:
            print("rocking: stopped.", file=sys.stderr)
            return 130
        except ModuleNotFoundError as error:
            if error.name != _OF_UNIX and _OF_UNIX not in str(error):
                raise
            print(f"rocking: {_NOT_HERE}", file=sys.stderr)
            return 1
        except OSError as error:
            print(f"rocking: {error.filename or 'file'}: {error.strerror or error}.", file=sys.stderr)
            return 1


_OF_UNIX = "fcntl"
"""The module of the standard library that locks files, which Windows lacks."""
_NOT_HERE = (
    "this command needs Linux or macOS; on Windows run it in WSL, or use the commands that run no study, such as "
    "`rocking assess`, and the functions of `import rocking`, which need no locks."
)


def _show(message: Warning | str, *_: object, **__: object) -> None:
    """A warning as one line for the reader, without the line of code that it came from."""
    print(f"rocking: {message}", file=sys.stderr)


def _parser() -> argparse.ArgumentParser:
    declarations = argparse.ArgumentParser(add_help=False)
    declarations.add_argument(
        "--unit", help="unit of the numbers, where the file states none: m/s2, cm/s2, g, ..."
    )
    declarations.add_argument("--time-step", type=float, help="time step in s, where the file states none")
    of_files = argparse.ArgumentParser(add_help=False, parents=[declarations])
    what = "files of accelerograms, in any format that is read, archives or folders of them, and their StationXML"
    of_files.add_argument("files", type=Path, nargs="+", metavar="FILE", help=what)
    of_files.add_argument("--scale", type=float, default=1.0, help="factor on the accelerations (default: 1)")
    channels = argparse.ArgumentParser(add_help=False, parents=[of_files])
    channels.add_argument("--component", default="", help="component to use (default: every horizontal one)")

    parser = argparse.ArgumentParser(
        prog="rocking",
        description="Rocking structures under recorded earthquakes.",
        epilog="Exit status: 0, all went well; 1, a record or a run failed; 2, what was asked for is wrong; 130, "
        "stopped by Ctrl-C.",
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {version('rocking')}")
    verbs = parser.add_subparsers(required=True, metavar="verb")

    def verb(function: Any, text: str, *parents: argparse.ArgumentParser) -> Any:
        name = function.__name__.removeprefix("_")
        subparser = verbs.add_parser(name, help=text, description=text, parents=parents)
        subparser.set_defaults(run=function)
        return subparser.add_argument

    add = verb(_start, "start a study in a folder of your own")
    add("folder", type=Path)
    add = verb(_catalogue, "write a catalogue of the accelerograms in a folder", declarations)
    add("folder", type=Path, help="folder of records, or of a study")
    add(
        "--output",
        type=Path,
        help="CSV file to write (default: catalogue.csv in the folder, or that of a study)",
    )
    add = verb(_run, "run the study in a folder")
    add("folder", type=Path, nargs="?", default=Path(), help="folder of the study (default: this one)")
    add(
        "snakemake",
        nargs=argparse.REMAINDER,
        help="a target such as summary, and options of snakemake such as -n or -j 2",
    )
    for product in PRODUCTS:
        made = verbs.add_parser(product.name, help=product.does, description=product.does)
        made.add_argument(
            "folder", type=Path, nargs="?", default=Path(), help="folder of the study (default: this one)"
        )
        made.set_defaults(run=_product, snakemake=[product.name])
    add = verb(_assess, "assess structures under accelerograms", channels)
    of_list = "list of structures: a file (YAML, CSV, XLSX), - for what comes in, or '{type: block, breadth_m: 1, ...}'"
    add("--structures", required=True, type=_list_of_structures, metavar="LIST", help=of_list)
    add("--name", help="name of one structure in the list (default: all)")
    add("--pdf", type=Path, help="file for the report of the record")
    add("--output", type=Path, help="folder for report.pdf and its tables")
    add = verb(_read, "read accelerograms and print their headers and peaks", of_files)
    of_each = "name what each reader looked for in a file that none recognised"
    add("--details", action="store_true", help=of_each)
    verb(_pulse, "print the dominant sine pulse of accelerograms", channels)
    add = verb(_spectrum, "print the rocking spectrum of accelerograms as CSV", channels)
    add("--restitution", type=float, default=0.9, help="velocity ratio of an impact, 0 to 1 (default: 0.9)")
    add("--output", type=Path, help="CSV file in place of the terminal")
    add = verb(
        _select, "select records for the design spectrum of a study, and write a catalogue with their factors"
    )
    add("folder", type=Path, nargs="?", default=Path(), help="folder of the study (default: this one)")
    add(
        "--output",
        type=Path,
        help="CSV file to write (default: selected.csv next to the catalogue of the pool)",
    )
    add = verb(
        _strengthen,
        "find the smallest value of one size of a structure that can be shown to hold under the records of a study",
    )
    add("folder", type=Path, help="folder of the study")
    add("structure", help="name of the structure in the list of the study")
    add("key", help="key of the list that is varied, such as tie_strength_kN_m or thickness_m")
    add("between", help="range of its values, such as 2..40")
    add("--target", type=float, default=0.1, help="share that may overturn (default: 0.1)")
    add(
        "--output",
        type=Path,
        help="folder for the table and the figure (default: strengthening in the results)",
    )
    return parser


def _parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Parse the command line; options of `run` that are none of ours are snakemake's, with -- before them or not."""
    parser = _parser()
    options, others = parser.parse_known_args(arguments)
    if options.run is not _run and others:
        parser.error(f"unrecognized arguments: {' '.join(others)}")
    if options.run is _run:
        options.snakemake = [option for option in (*others, *options.snakemake) if option != "--"]
    return options


def _list_of_structures(text: str) -> str:
    """Return `text`; raises ArgumentTypeError for braces that the shell cut at their first blank."""
    if text.startswith("{") and not text.rstrip().endswith("}"):
        raise argparse.ArgumentTypeError(
            f"{text!r} ends within its braces; put them and all between them into quotation marks, as in "
            "'{type: block, breadth_m: 1, height_m: 4}'"
        )
    return text


def _start(options: argparse.Namespace) -> None:
    from rocking.study.workspace import start

    records = options.folder / "records"
    print(*start(options.folder), f"Put your records into {records}, then:", sep="\n")
    print(f"  rocking catalogue {quote(str(records))}")
    print(f"  rocking run {quote(str(options.folder))}")


def _catalogue(options: argparse.Namespace) -> None:
    from rocking.study.workspace import records_of, write_catalogue

    folder, target = records_of(options.folder)
    print(write_catalogue(folder, options.output or target, options.unit, options.time_step))


def _run(options: argparse.Namespace) -> int:
    from rocking.study.run import run

    return run(options.folder, options.snakemake)


def _product(options: argparse.Namespace) -> int:
    return _run(options)


def _select(options: argparse.Namespace) -> None:
    from rocking.study.selection import write_selection

    print(*write_selection(options.folder, options.output), sep="\n")


def _strengthen(options: argparse.Namespace) -> None:
    from rocking.study.strengthening import write_strengthening

    lines = write_strengthening(
        options.folder,
        options.structure,
        options.key,
        options.between,
        options.target,
        options.output,
        lambda line: print(line, file=sys.stderr),
    )
    print(*lines, sep="\n")


def _read(options: argparse.Namespace) -> int:
    from rocking.signal.scaling import scaled
    from rocking.study.own_files import read_files

    try:
        own = read_files(options.files, _declared(options))
    except UnknownFormatError as error:
        if options.details:
            print("\n".join(error.details))
        raise
    for path, records in own.channels.items():
        if len(own.channels) > 1:
            print(f"{path}:")
        for record in records:
            accelerogram = record if options.scale == 1 else scaled(record, options.scale)
            peak = accelerogram.peak_acceleration
            print(
                f"{accelerogram.source.format}: {accelerogram.event or 'event not named'}, "
                f"{accelerogram.station or 'station not named'}, component {accelerogram.component or 'not named'}: "
                f"{accelerogram.acceleration.size} samples every {accelerogram.time_step:g} s, "
                f"peak {peak:.4g} m/s² = {peak / GRAVITY:.4g} g"
            )
            for sentence in (*accelerogram.processing, *accelerogram.warnings):
                print(f"  {sentence}")
    return _refusals(own)


def _pulse(options: argparse.Namespace) -> int:
    from rocking.pulses import extract_pulses

    own, accelerograms = _accelerograms(options)
    for accelerogram in accelerograms:
        analysis = extract_pulses(accelerogram)
        pulse = analysis.dominant
        of = f"{accelerogram.station}, " if len(own.stations) > 1 and accelerogram.station else ""
        print(
            f"{of}component {accelerogram.component or 'not named'}: amplitude {pulse.amplitude:.4g} m/s² = "
            f"{pulse.amplitude / GRAVITY:.4g} g, period {pulse.period:.4g} s, start {pulse.start_time:.3f} s, "
            f"explains {analysis.explained_energy:.0%} of the acceleration energy"
        )
        for sentence in (*analysis.flags, *accelerogram.processing):
            print(f"  {sentence}")
    return _refusals(own)


def _assess(options: argparse.Namespace) -> int:
    from rocking.study.own_files import STDIN, assess_stations, scenes_of, stations_of

    stdin = sys.stdin.buffer.read() if options.structures == STDIN else None
    scenes = scenes_of(options.structures, stdin)
    own = stations_of(options.files, _declared(options))
    print(*assess_stations(own.stations, scenes, options.name, options.output, options.pdf), sep="\n")
    written = [
        options.output / station.record.id / "report.pdf" for station in own.stations if options.output
    ]
    print(
        *written,
        *([options.pdf] if options.pdf else []),
        sep="\n",
        end="\n" if written or options.pdf else "",
    )
    return _refusals(own)


def _spectrum(options: argparse.Namespace) -> int:
    import numpy as np

    from rocking.assessment.rows import SpectrumRow, spectrum_rows
    from rocking.tables import check_target, csv_lines, document_of, write_rows

    if options.output is not None:
        check_target(options.output, document_of(SpectrumRow))
    axes = np.geomspace(0.5, 10, 40), np.geomspace(0.02, 1, 40)  # p in rad/s, and uplift multiplier
    own, accelerograms = _accelerograms(options)
    rows = spectrum_rows(accelerograms, *axes, options.restitution)
    if options.output is None:
        print(*csv_lines(SpectrumRow, rows), sep="", end="")  # all of it, or the sentence of an error
    else:
        write_rows(SpectrumRow, rows, options.output)
        print(options.output)
    return _refusals(own)


def _accelerograms(options: argparse.Namespace) -> Any:
    """The files, and the horizontal components of their stations, processed as a study would."""
    from rocking.study.job import Study
    from rocking.study.own_files import stations_of

    own = stations_of(options.files, _declared(options))
    opened = [Study({}).open(station.record, list(station.channels))[0] for station in own.stations]
    return own, [accelerogram for horizontal in opened for accelerogram in horizontal]


def _declared(options: argparse.Namespace) -> Any:
    from rocking.study.own_files import Declared

    return Declared(options.unit, options.time_step, options.scale, getattr(options, "component", ""))


def _refusals(own: Any) -> int:
    """Print what there is to say of the files besides their records; 1 where one of them could not be read."""
    for warning in (*own.warnings, *own.refused):
        print(f"rocking: {warning}", file=sys.stderr)
    return 1 if own.refused else 0


if __name__ == "__main__":
    raise SystemExit(main())
