"""Kinemetrics EVT (Altus K2, Etna, Makalu): counts, with full scale and sensitivity in the file itself."""

from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram, without_offset
from rocking.records.formats.waveform import joined, stream

_OBSPY_G = 9.81
"""obspy turns the sensitivity in V/g into V/(m/s²) with this g."""

_COMPONENTS = "XYZ"


def _recognise(content: bytes) -> bool:
    return content[:1] == b"K" and content[:32].count(b"KMI") == 1


def _read(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    options.unit_of(name, "m/s2")
    result, warnings = stream(content, "KINEMETRICS_EVT", name, apply_calib=False)
    return [_record(trace, i, name, options, warnings) for i, trace in enumerate(joined(result, name))]


def _record(trace, index: int, name: str, options: Options, warnings: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    values, offset = without_offset(trace.data.astype(float) * stats.calib * (GRAVITY / _OBSPY_G), "m/s2")
    component = str(stats.kinemetrics_evt.get("chan_id", "")).strip() or _COMPONENTS[index % 3]
    return accelerogram(
        name,
        EVT.name,
        "m/s2",
        values,
        options.time_step_of(name, float(stats.delta)),
        component=component,
        station=stats.station,
        event=str(stats.starttime)[:10],
        start_time=str(stats.starttime),
        processing=(offset,),
        warnings=warnings,
        vertical=component.upper() in ("Z", "V", "UP") or index == 2,
    )


EVT = Format("Kinemetrics EVT", "KMI mark at the start of the file", _recognise, _read)
