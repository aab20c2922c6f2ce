"""One file per strong-motion format, each a recogniser and a reader; FORMATS lists them all."""

from rocking.records.formats.afad import AFAD
from rocking.records.formats.bhrc import BHRC
from rocking.records.formats.columns import COLUMNS, TITLED
from rocking.records.formats.cosmos import COSMOS
from rocking.records.formats.csmip import CSMIP, SPECTRA
from rocking.records.formats.csmnc import CSMNC
from rocking.records.formats.cwb import CWB
from rocking.records.formats.dyna import DYNA
from rocking.records.formats.evt import EVT
from rocking.records.formats.format import Format, Options
from rocking.records.formats.geonet import GEONET
from rocking.records.formats.knet import KNET
from rocking.records.formats.miniseed import MINISEED, STATIONXML
from rocking.records.formats.peer import PEER_AT2, PEER_OTHER
from rocking.records.formats.renadic import RENADIC
from rocking.records.formats.resorce import RESORCE
from rocking.records.formats.sac import SAC
from rocking.records.formats.smc import SMC
from rocking.records.formats.unam import UNAM
from rocking.records.formats.usc import USC

FORMATS: tuple[Format, ...] = (
    PEER_AT2, PEER_OTHER, COSMOS, CSMIP, SPECTRA, SMC, USC, KNET, DYNA, AFAD, RESORCE, GEONET, UNAM, BHRC, RENADIC, CWB,
    CSMNC, EVT, SAC, MINISEED, STATIONXML, TITLED, COLUMNS,
)  # fmt: skip
"""Every format there is. Exactly one recognises a file; the order does not matter."""

__all__ = ["FORMATS", "Format", "Options"]
