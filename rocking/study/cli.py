"""The `rocking` command: few verbs, each one call of the same functions as the workflow."""

import argparse
import sys
import warnings
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from shlex import quote

from rocking.errors import CatalogueError, ConfigurationError, RockingError, UnknownFormatError
from rocking.quantities import GRAVITY, counted
from rocking.study import close_doors


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    0: all went well. 1: a record or a run failed. 2: what was asked for is wrong, such as a setting; it says why.
    """
    options = _parser().parse_args(arguments)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _say
            close_doors()
            return options.run(options) or 0
    except RockingError as error:
        print(f"rocking: {error}", file=sys.stderr)
        return 2 if isinstance(error, ConfigurationError | CatalogueError) else 1
    except KeyboardInterrupt:
        print("rocking: stopped.", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"rocking: {error.filename or 'file'}: {error.strerror or error}.", file=sys.stderr)
        return 1


def _say(message: Warning | str, *_: object, **__: object) -> None:
    """A warning as one line for the reader, without the line of code that it came from."""
    print(f"rocking: {message}", file=sys.stderr)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rocking", description="Rocking structures under recorded earthquakes."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {version('rocking')}")
    verbs = parser.add_subparsers(required=True, metavar="verb")
    start = _verb(verbs, "start", _start, "start a study in a folder of your own")
    start.add_argument("folder", type=Path)
    catalogue = _verb(verbs, "catalogue", _catalogue, "write a catalogue of the accelerograms in a folder")
    catalogue.add_argument("folder", type=Path)
    catalogue.add_argument("--output", type=Path, help="CSV file to write (default: catalogue.csv in it)")
    _declarations(catalogue)
    run = _verb(verbs, "run", _run, "run the study in a folder")
    run.add_argument("folder", type=Path, nargs="?", default=Path(), help="of the study (default: this one)")
    run.add_argument(
        "snakemake", nargs="*", help="a target such as trade; what follows -- goes to snakemake: -- --dry-run"
    )
    tables = _verb(verbs, "tables", _tables, "write the tables of records of a study that has been run")
    tables.add_argument("results", type=Path, help="folder of the results of a study")
    tables.add_argument("record", nargs="+", help="identifier in the catalogue")
    reading = _record_verb(verbs, "read", _read, "read a file and say what it is")
    reading.add_argument(
        "--details", action="store_true", help="of a file that is not recognised: what each reader looked for"
    )
    for name, function, text in (
        ("pulse", _pulse, "dominant sine pulse of a file"),
        ("assess", _assess, "assess structures under a file"),
        ("spectrum", _spectrum, "rocking spectrum of a file as CSV"),
    ):
        verb = _record_verb(verbs, name, function, text)
        verb.add_argument("--component", default="", help="component to use (default: every horizontal one)")
    _assess_options(verbs.choices["assess"])
    verbs.choices["spectrum"].add_argument(
        "--restitution", type=float, default=0.9, help="velocity ratio of an impact, 0 to 1 (default: 0.9)"
    )
    verbs.choices["spectrum"].add_argument(
        "--output", type=Path, default=Path("spectrum.csv"), help="CSV file"
    )
    return parser


def _verb(verbs, name: str, function, text: str) -> argparse.ArgumentParser:
    parser = verbs.add_parser(name, help=text, description=text)
    parser.set_defaults(run=function)
    return parser


def _record_verb(verbs, name: str, function, text: str) -> argparse.ArgumentParser:
    parser = _verb(verbs, name, function, text)
    parser.add_argument("file", type=Path, help="accelerogram in any known format")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the accelerations (default: 1)")
    _declarations(parser)
    return parser


def _declarations(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--unit", help="of the numbers, where the file does not say it: m/s2, cm/s2, g, ...")
    parser.add_argument("--time-step", type=float, help="in s, where the file does not say it")


def _assess_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("structures", type=Path, help="YAML file that lists structures")
    parser.add_argument("name", nargs="?", help="name of one structure in the list (default: all)")
    parser.add_argument("--output", type=Path, help="folder for report.pdf and the tables behind it")


def _start(options: argparse.Namespace) -> None:
    from rocking.study.workspace import start

    for path in start(options.folder):
        print(path)
    records = options.folder / "records"
    print(f"Put your records into {records}, then:")
    print(f"  rocking catalogue {quote(str(records))}")
    print(f"  rocking run {quote(str(options.folder))}")


def _catalogue(options: argparse.Namespace) -> None:
    from rocking.records.folder import listing_text
    from rocking.study.workspace import write_catalogue

    target = options.output or options.folder / "catalogue.csv"
    written = write_catalogue(options.folder, target, unit=options.unit, time_step=options.time_step)
    print(listing_text(written.files), end="")
    for gone in written.gone:
        print(
            f"{gone}: its row stays in the catalogue, but its file is not there; remove the row or add the file."
        )
    print(f"{target}: {counted(written.records, 'record')}, {written.new} of them new")


def _run(options: argparse.Namespace) -> int:
    from rocking.study.run import run

    return run(options.folder, options.snakemake)


def _tables(options: argparse.Namespace) -> None:
    from rocking.study.results import open_results

    results = open_results(options.results)
    for record in options.record:
        print(results.write_record(record)[0].parent)


def _read(options: argparse.Namespace) -> None:
    from rocking.records import read
    from rocking.records.plausibility import scaled

    try:
        records = read(options.file, unit=options.unit, time_step=options.time_step)
    except UnknownFormatError as error:
        if options.details:
            print("\n".join(error.details))
        raise
    for found in records:
        accelerogram = found if options.scale == 1 else scaled(found, options.scale)
        peak = accelerogram.peak_acceleration
        print(
            f"{accelerogram.source.format}: {accelerogram.event or 'event not named'}, "
            f"{accelerogram.station or 'station not named'}, component {accelerogram.component or 'not named'}: "
            f"{accelerogram.acceleration.size} samples every {accelerogram.time_step:g} s, "
            f"peak {peak:.4g} m/s² = {peak / GRAVITY:.4g} g"
        )
        for sentence in (*accelerogram.processing, *accelerogram.warnings):
            print(f"  {sentence}")


def _pulse(options: argparse.Namespace) -> None:
    from rocking.pulses import extract_pulses

    for accelerogram in _accelerograms(options):
        analysis = extract_pulses(accelerogram)
        pulse = analysis.dominant
        print(
            f"component {accelerogram.component or 'not named'}: amplitude {pulse.amplitude:.4g} m/s² = "
            f"{pulse.amplitude / GRAVITY:.4g} g, period {pulse.period:.4g} s, start {pulse.start_time:.3f} s, "
            f"explains {analysis.explained_energy:.0%} of the acceleration energy"
        )
        for sentence in (*analysis.flags, *accelerogram.processing):
            print(f"  {sentence}")


def _assess(options: argparse.Namespace) -> None:
    from rocking.study.settings import Settings
    from rocking.study.single_record import assess_file

    own = _own_file(options)
    print("\n".join(assess_file(own, options.structures, options.name, Settings(), options.output)))
    if options.output is not None:
        print(options.output / own.record.id / "report.pdf")


def _spectrum(options: argparse.Namespace) -> None:
    from rocking.study.single_record import write_spectrum

    write_spectrum(_accelerograms(options), options.restitution, options.output)
    print(options.output)


def _accelerograms(options: argparse.Namespace):
    """The horizontal components of the file, processed as a study would."""
    from rocking.study.job import Study

    own = _own_file(options)
    return Study({}).opened(own.channels, own.record)[0]


def _own_file(options: argparse.Namespace):
    from rocking.study.single_record import Declared, read_own

    return read_own(options.file, Declared(options.unit, options.time_step, options.scale, options.component))


if __name__ == "__main__":
    raise SystemExit(main())
