"""One file per strong-motion format, each a recogniser and a reader; FORMATS lists them all."""

from rocking.records.formats.columns import COLUMNS, TITLED
from rocking.records.formats.evt import EVT
from rocking.records.formats.format import Format, Options
from rocking.records.formats.knet import KNET
from rocking.records.formats.miniseed import MINISEED, STATIONXML
from rocking.records.formats.peer import PEER_AT2, PEER_OTHER
from rocking.records.formats.sac import SAC

FORMATS: tuple[Format, ...] = (
    PEER_AT2,
    PEER_OTHER,
    KNET,
    MINISEED,
    STATIONXML,
    SAC,
    EVT,
    TITLED,
    COLUMNS,
)
"""Every format there is. Exactly one recognises a file; the order does not matter."""

__all__ = ["FORMATS", "Format", "Options"]
