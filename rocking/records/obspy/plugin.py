"""Our text formats as obspy waveform plug-ins: `obspy.read("file.AT2")` understands them once we are installed.

obspy finds `is_<name>` and `read_<name>` by the entry points of pyproject.toml. Plain columns are left out: they carry
no unit, and claiming every file of bare numbers would take other programs' files; K-NET, EVT, SAC and miniSEED are
obspy's own already.
"""

from functools import partial
from pathlib import Path
from typing import Any

from rocking.records.formats import FORMATS, Format, Options
from rocking.records.read import LARGEST_FILE, bare_text, read_content, unpack
from rocking.tables import read_start

_HEAD = 2**16


def is_format(form: Format, source: Any) -> bool:
    """Whether `source`, a path or an open binary file, is of this format; False for whatever cannot be read."""
    try:
        return form.recognise(bare_text(unpack(_bytes(source, _HEAD), "file")))
    except Exception:
        return False


def read_format(form: Format, source: Any, **options: Any) -> Any:
    """Return obspy's Stream, in m/s², of `source`, a path or an open binary file.

    options: unit and time_step where the file is silent; what obspy adds is ignored. Raises RecordError.
    """
    from obspy import Stream  # which takes a second to import, and loads this module itself

    name = Path(str(source)).name if isinstance(source, str | Path) else "file"
    content = unpack(_bytes(source, LARGEST_FILE), name)
    declared = Options(unit=options.get("unit"), time_step=options.get("time_step"))
    return Stream([record.to_obspy() for record in read_content(content, name, declared, reader=form)])


def _bytes(source: Any, limit: int) -> bytes:
    if hasattr(source, "read"):
        return bytes(source.read(limit))
    return read_start(Path(source), limit)


for _form in filter(lambda form: form.plugin, FORMATS):
    globals()[f"is_{_form.plugin.lower()}"] = partial(is_format, _form)
    globals()[f"read_{_form.plugin.lower()}"] = partial(read_format, _form)
