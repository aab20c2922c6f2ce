"""A small file of each text format, made here: what its header declares and how its columns stand."""

import struct
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import obspy

from rocking.records import Accelerogram
from rocking.records.formats import Options
from rocking.records.obspy import workspace
from rocking.records.read import read_content

N = 40
STEP = 0.01
TRUE = 0.9 * np.sin(np.arange(N) / 3.0) * np.linspace(1, 0.2, N)
"""m/s²; what every sample file holds, each in its own unit and number of digits."""


def peak_time() -> float:
    """Time of the largest sample, s after the first."""
    return float(np.abs(TRUE).argmax()) * STEP


def columns(values: np.ndarray, per_line: int, form: str) -> str:
    lines = (values[i : i + per_line] for i in range(0, values.size, per_line))
    return "".join("".join(format(v, form) for v in line) + "\n" for line in lines)


def peer(factor: float = 1.0) -> str:
    head = "PEER NGA STRONG MOTION DATABASE RECORD\nQuake, 1/2/1999, Station, 45\n"
    head += "ACCELERATION TIME SERIES IN UNITS OF G\n"
    return f"{head}NPTS= {N}, DT= {STEP} SEC\n" + columns(factor * TRUE / 9.80665, 5, "15.7E")


def peer_2008() -> str:
    text = peer().replace("TIME SERIES", "TIME HISTORY")
    return text.replace(f"NPTS= {N}, DT= {STEP} SEC", f"{N}    {STEP}    NPTS, DT")


def cosmos(stated: float = 1.0) -> str:
    reals = np.full(100, -999.0)
    gal = 100 * TRUE
    place = np.abs(gal).argmax()
    reals[33] = STEP / 2  # the recorder's, which is not the series'
    reals[61:65] = 1000 * STEP, N * STEP, stated * gal[place], place * STEP
    return (
        "Corrected acceleration    (Format v01.20 with 13 text lines) Src: made.txt\nRcrd of Some Day\n"
        "Hypocenter:\nOrigin:\nStatn No: 01-1  Code:CE-J1  Made\nCoords:\nRecorder:\nRcrd start time:\n"
        "Sta Chan  1: 45 deg (Rcrdr Chan  1) Location:\nRaw record length\nProcessed:\n"
        "Record filtered below 0.30  Hz (periods over 3 secs)\nValues used when unknown: -999\n"
        " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" + columns(np.full(100, -999), 10, "8d")
        + " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n" + columns(reals, 6, "13.6f")
        + '  1 Comment line(s) follow, each starting with a "|":\n| made\n'
        + f"   {N} acceleration pts, approx 1 secs, units=cm/sec2(04),Format=(8F10.5)\n" + columns(gal, 8, "10.5f")
        + "End-of-data for Chan  1 acceleration\n"
    )  # fmt: skip


def csmip(stated: float = 1.0) -> str:
    peak = stated * np.abs(TRUE).max() * 100
    return (
        "Corrected accelerogram   1-2-3       Chan  1: 45 Deg     from\n"
        "Uncorrected Accelerogram Data   Processed: 1/1/12\nStation No. 89146   40.9N, 123.6W\nChan  1: 45 Deg\n"
        "Accelerogram bandpass filtered with 3 dB pts at   .30 and 40.00\n"
        f"Peak acceleration = {peak:9.3f}    cm/sec/sec  at  {peak_time():.3f} sec.\n"
        f" {N} points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)\n"
        + columns(100 * TRUE, 8, "10.5f")
        + "/&  ----------  End of data for channel  1  ----------\n"
    )  # fmt: skip


def smc(stated: float = 1.0) -> str:
    integers, reals = np.full(48, -32768), np.full(50, 1.7e38)
    integers[15], integers[16] = 1, N
    reals[[1, 29, 31, 32]] = 1 / STEP, stated * 100 * TRUE.max(), stated * 100 * TRUE.min(), 0.1
    reals[[28, 30]] = TRUE.argmax() * STEP, TRUE.argmin() * STEP
    text = (
        "2 CORRECTED ACCELEROGRAM\n*\nMADE\n     1989  10  18    0004 Quake\n*\nstation = Made     component=     45\n"
        + "*\n" * 5
    )
    # Two digits of exponent and a sign in front: the columns touch, as they do in the real files.
    head = text + columns(integers, 8, "10d") + columns(reals, 5, "15.7E")
    return head + "| one\n" + columns(100 * TRUE, 8, "10.3E")


def volume1(first: str, chan: str, units: str, last: str, rate: float = 0.0) -> str:
    reals = np.zeros(50)
    reals[8] = rate
    return (
        f"{first}\nQUAKE\n1/2/99\n1\n{chan}\nUNIVERSIDAD DE CHILE - RENADIC\nx\nx\nx\nINSTR PERIOD\n"
        f"NO. OF POINTS =   {N}  RECORD LENGTH = {N * STEP:.3f} SEC\n{units}\nRMS\n"
        + columns(np.zeros(100, int), 16, "5d") + columns(reals, 8, "10.3f") + "{}" + last
    )  # fmt: skip


def pairs() -> np.ndarray:
    return np.column_stack([np.arange(N) * STEP, TRUE / 0.980665]).ravel()


def usc() -> str:
    first = "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:"
    head = volume1(first, "COMP N45E", "UNITS ARE SEC AND G/10", "")
    body = columns(pairs(), 10, "7.3f").replace("\n", "\n ")
    return head.format(" " + body[:-1])


def renadic(stated: float = 1.0) -> str:
    peak = stated * np.abs(TRUE).max() / 9.80665
    units = f"UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = {peak:6.3f} G, AT   1 SEC"
    first = "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 1/1/11"
    text = volume1(first, "CHAN  1: EW       (STA CHN:  1)", units, "/&  END OF DATA\n")
    return text.format(columns(pairs(), 10, "7.3f"))


def bhrc() -> str:
    head = volume1("* VOL1DS FILE:  1/01", "COMP L1", "UNITS ARE SECONDS AND G/10", "/&\n", rate=1 / STEP)
    head = head.replace("RECORD LENGTH =", "DURATION =")
    return head.replace("1/2/99\n1\n", "1/2/99\nAzimuth L 45 T 135\n").format(
        columns(TRUE / 0.980665, 10, "13.6E")
    )


def knet(stated: float = 1.0) -> str:
    keys = ("Origin Time", "Lat.", "Long.", "Depth. (km)", "Mag.", "Station Code", "Station Lat.", "Station Long.",
            "Station Height(m)", "Record Time", "Sampling Freq(Hz)", "Duration Time(s)", "Dir.", "Scale Factor",
            "Max. Acc. (gal)", "Last Correction", "Memo.")  # fmt: skip
    gal = 100 * (TRUE - TRUE.mean())
    peak = f"{stated * np.abs(gal).max():.3f}"
    values = ("2018/01/24 19:51:00", "41", "142", "30", "6.2", "MADE01", "41", "140", "39", "2018/01/24 19:51:43",
              "100Hz",
              f"{N * STEP:g}", "E-W", "2000(gal)/8388608", peak, "2018/01/24 19:51:43", "")  # fmt: skip
    head = "".join(f"{key:<18}{value}\n" for key, value in zip(keys, values, strict=True))
    return head + columns(np.round(gal * 8388608 / 2000).astype(int), 8, "9d")


def dyna(stated: float = 1.0) -> str:
    values = 100 * TRUE
    pairs = {"EVENT_NAME": "MADE", "STATION_CODE": "X", "SAMPLING_INTERVAL_S": STEP, "NDATA": N, "STREAM": "HNE",
             "UNITS": "cm/s^2", "DURATION_S": f"{N * STEP:.3f}", "TIME_PGA_S": f"{np.abs(values).argmax() * STEP:.6f}",
             "PGA_CM/S^2": f"{stated * np.abs(values).max():.6f}", "LOW_CUT_FREQUENCY_HZ": "0.1",
             "DATA_TYPE": "ACCELERATION", "USER1": ""}  # fmt: skip
    return "".join(f"{key}: {value}\n" for key, value in pairs.items()) + columns(values, 1, ".6f")


def dyna_filtered_anew() -> str:
    """As AFAD gives the earthquakes of 2023: lines AAD_ above, slashes in dates, a peak of before the filter."""
    above = "AAD_Filtered_TADAS_FILE\nAAD_FILTER_ORDER: 1\nAAD_LOW_CUT_FREQUENCY_HZ: 0.025\n"
    begin = "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 2023/02/06 01:17:07.3320300\n"
    return above + dyna(1.5).replace("DURATION_S: 0.400", "DURATION_S: ").replace("NDATA", f"{begin}NDATA")


def jma() -> str:
    gal = np.column_stack([100 * TRUE, 50 * TRUE, 10 * TRUE])
    rows = "".join(",".join(f"{value:.3f}" for value in row) + "\n" for row in gal)
    return (
        "SITE CODE= 9CFMADE     ,32.7,130.8, 11,6.5\n LAT.=   32.6\n LON.=  130.7\n SAMPLING RATE= 100Hz\n"
        " UNIT  = gal(cm/s/s)\nINITIAL TIME = 2016 04 14 21 26 20\n NS,EW,UD\n" + rows
    )  # fmt: skip


def emod3d() -> str:
    head = f"MADE       090 \n{N}  {STEP:.5e} 0 0" + "  0.00000e+00" * 4
    return f"{head}\n" + columns(TRUE / 9.80665, 6, "13.5e")


def afad(stated: float = 1.0) -> str:
    gal = np.column_stack([100 * TRUE, -50 * TRUE, 10 * TRUE])
    north, east, up = stated * np.abs(gal).max(axis=0)
    peaks = f"(N-S) {north:.6f} (E-W) {east:.6f} (U-D) {up:.6f}"
    return (
        f"STRONG GROUND MOTION RECORDS OF TURKIYE\nSTATION ID              : 0921\nNUMBER OF DATA          : {N}\n"
        f"SAMPLING INTERVAL (sec) : {STEP}\nRAW PGA VALUES (gal)    : {peaks}\nCopyright\n   N-S   E-W   U-D\n"
        + columns(gal.ravel(), 3, "14.6f")
    )  # fmt: skip


def resorce(stated: float = 1.0) -> str:
    return (
        f"Event Date & Time             : 2009-04-06 01:32:39\nOrientation                   : NS\n"
        f"Filter Cut-off Frequency (Hz) : 0.100 - 50.000\nTime Increment (s)            : {STEP}\n"
        f"Number of Data                : {N}\nPGA (m/s/s)                   : {stated * np.abs(TRUE).max():.7E}\n"
        "Accelaration time series in m/s/s\n" + columns(TRUE, 5, "14.7E")
    )  # fmt: skip


def esd() -> str:
    """The layout of the database's own page on its files, with an example of 1999."""
    return (
        "file:                         002727xa.cor\nearthquake code:                 990\n"
        "station code:                    694\ntotal number of channels:     3\n"
        "orientation of transducer:    NS\nfull scale amplitude:          0.50g\n"
        f"time of first sample:         31.12.1999 04:55:53.671UTC\nsampling period:               {STEP:.6f}s\n"
        f"number of samples:             {N}\nrecord length:                {(N - 1) * STEP:.3f}s\n"
        "units:                        m/s*s, m/s & s\ncomments & processing history:\n"
        "%-  8th order elliptical bandpass-filter (0.25-25.00Hz)\n-> corrected acceleration time histories\n"
        + columns(TRUE, 8, "13.5E")
    )  # fmt: skip


def geonet(stated: float = 1.0) -> str:
    return (
        "Uncorrected accelerogram 1 GNS Science\nSite WTMC      42 37 10S\n"
        + "x\n" * 7 + f"Number of points  {N}    Duration\n"
        f"Raw readings in units of 0.50 mm/s/s  at intervals of {STEP:.3f} s\nData is unfiltered\nComponent N45E\n"
        f"Acceleration:  Peak {stated * np.abs(TRUE).max() * 1000:.1f} mm/s/s at {peak_time():.2f} s\n"
        "Velocity\nDisplacement\n"
        + columns(np.zeros(40, int), 10, "8d") + columns(np.zeros(60), 10, "8.3f") + columns(2000 * TRUE, 10, "8.1f")
    )  # fmt: skip


def unam(stated: float = 1.0) -> str:
    gal = np.column_stack([100 * TRUE, 50 * TRUE])
    place = np.abs(TRUE).argmax() + 1
    peak = stated * np.abs(gal).max()
    return (
        "*****\nARCHIVO ESTANDAR DE ACELERACION:\nCLAVE DE LA ESTACION                   : ACAC\n"
        "ORIENTACION C1-C6 (rumbo;orientacion)  : /N45E/V\nINTERVALO DE MUESTREO, C1-C6 (s)       : /0.01/0.01\n"
        f"NUM. TOTAL DE MUESTRAS, C1-C6          : /{N}/{N}\n"
        f"ACEL. MAX.(Gal), C1-C6                 : /{peak:.4f}/{peak / 2:.4f}\n"
        f"ACEL. MAX., C1-C6, EN LA MUESTRA       : /{place}/{place}\n"
        "VEL. DE MUESTREO, C1-C6 (muestras/s)   : /100/100\n"
        f"DURACION DEL REGISTRO (s), C1-C6       : /{N * STEP:.2f}/{N * STEP:.2f}\n"
        "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)\nFORMATO DATOS (FORTRAN,10 campos/dato) : 2F10.4\n"
        f"DATOS DE ACELERACION:\n{'-' * 79}\n CANAL-1 CANAL-2\n N45E V\n{'-' * 79}\n" + columns(gal.ravel(), 2, "10.4f")
    )  # fmt: skip


def cwb(stated: float = 1.0) -> str:
    gal = 100 * TRUE
    rows = np.column_stack([np.arange(N) * STEP, 0.1 * gal, gal])
    return (
        f"#Earthquake Information\n#StationCode: EAS\n#RecordLength(sec): {N * STEP:.2f}\n#SampleRate(Hz): 100\n"
        f"#AmplitudeUnit:  gal. DCoffset(corr)\n#AmplitudeMAX. N: {stated * gal.max():.3f}~ {stated * gal.min():.3f}\n"
        "#DataSequence: Time U(+); N(+)\n#Data: 3F10.3\n" + columns(rows.ravel(), 3, "10.3f")
    )  # fmt: skip


def csmnc(stated: float = 1.0) -> str:
    head = ["065JZC", "01", "QUAKE", "EPICENTER", "MAGNITUDE", "STATION: 65JZC", "SITE", "INSTRUMENT",
            "OBSERVING POINT: GROUND", "COMP. EW", "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC",
            f"NO. OF POINTS:  {N}  EQUALLY SPACED INTERVALS OF:  {STEP}  SEC",
            f"PEAK VALUE: {stated * 100 * np.abs(TRUE).max():.3f}   AT {peak_time():.2f} SEC",
            "PRE-EVENT", "CSMNC", ""]  # fmt: skip
    return "\n".join(head) + "\n" + columns(100 * TRUE, 8, "14.6E")


def titled() -> str:
    return f"made\n{N} {STEP}\n" + columns(TRUE, 1, ".6E")


def table() -> str:
    rows = (f"{i * STEP:.2f},{v:.7f},{2 * v:.7f}\n" for i, v in enumerate(TRUE))
    return "time,acc_NS(m/s2),acc_EW(m/s2)\n" + "".join(rows)


def csmip_of_1983(stated: float = 1.0) -> str:
    """Volume 2 as the CDMG wrote it until the nineties: capitals, and the unit in brackets after the step."""
    gal = 100 * TRUE
    peak, at = stated * np.abs(gal).max(), np.abs(gal).argmax() * STEP

    def block(quantity: str, unit: str, values: np.ndarray) -> str:
        announced = f" {N} POINTS OF {quantity} DATA EQUALLY SPACED AT  {STEP:.3f} SEC.  (UNITS: {unit})\n"
        return announced + columns(values, 8, "10.3f")

    speed = STEP * (np.cumsum(gal) - (gal + gal[0]) / 2)

    return (
        "CORRECTED ACCELEROGRAM   36456-S4384-83123.01       CHAN  1:  45 DEG     FROM\n"
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  6/06/83, CDMG QC83A456\nMADE EARTHQUAKE\n"
        "STATION NO. 36456   35.908N, 120.458W     SMA-1  S/N 4384\nCHAN  1:  45 DEG\n"
        "ACCELEROGRAM BANDPASS FILTERED WITH RAMPS AT  .050- .100 AND 23.00-25.00 CYC/SEC\n"
        f"  {N} POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA\n"
        f"AT EQUALLY-SPACED INTERVALS OF    {STEP:.3f}  SEC.\n"
        f"PEAK ACCELERATION =  {peak:.3f}    CM/SEC/SEC  AT   {at:.3f}   SEC.\n"
        + columns(np.zeros(100, int), 16, "5d") + columns(np.zeros(100), 8, "10.3f")
        + block("ACCEL", "CM/SEC/SEC", gal) + block("VELOC", "CM/SEC", speed) + block("DISPL", "CM", speed)
        + "/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n"
    )  # fmt: skip


def usc_2(stated: float = 1.0) -> str:
    """Volume 2 of USC, like 017m30bt.s0a (Northridge 1994): the header's extremes have the samples' sign reversed."""
    gal = 100 * TRUE
    at = int(np.abs(gal).argmax())
    speed = STEP * (np.cumsum(gal) - (gal + gal[0]) / 2)

    def block(quantity: str, unit: str, values: np.ndarray) -> str:
        announced = f"  {N} POINTS OF {quantity} DATA EQUALLY SPACED AT   {STEP:.3f} SEC.  IN UNITS {unit}\n"
        return announced + columns(values, 8, "10.3f")

    blocks = block("ACC", "CM/SEC/SEC", gal) + block("VEL", "CM/SEC", speed) + block("DIS", "CM", speed)
    return (
        "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N45E   FILE   0  CORRESPONDING T \n"
        "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nMADE EARTHQUAKE\nJAN 17, 1994 -1230 GMT\n"
        "IBB127  94.610.0 N\nSTATION USC# 0061   34 17 11N, 118 13 31W\nMADE, CA\nCOMP N45E\n"
        "NO. OF POINTS =   8820      DURATION =  37.714 SEC\nUNITS ARE SEC AND G/10\n"
        "ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .225- .325 AND 25.00-27.00 HZ.\n"
        f"  {N}  INSTRUMENT AND BASELINE CORRECTED DATA\nAT EQUALLY-SPACED INTERVALS OF    {STEP:.3f}  SEC.\n"
        f"PEAK ACCELERATION = {-stated * gal[at]:.5f}  CMS/SEC/SEC AT    {at * STEP:.3f}   SEC.\n"
        "MAGNITUDE =  6.7    EPICENTRAL DISTANCE =  29.76 KM    M.M.I. =  8.\n"
        + columns(np.zeros(100, int), 16, "5d") + columns(np.zeros(100), 8, "10.3f") + blocks
    )  # fmt: skip


def csmip_raw(stated: float = 1.0) -> str:
    """The raw volume of the CDMG, digital: evenly spaced, in g."""
    text = csmip_film(stated).replace("ARE SEC AND G/10.", "IS G.")
    body = f"{N} POINTS OF ACCEL DATA EQUALLY SPACED AT {STEP:.3f} SEC.  (UNITS: G)\n"
    return text.replace(columns(pairs(), 10, "7.3f"), body + columns(TRUE / 9.80665, 8, "9.6f"))


def csmip_film(stated: float = 1.0) -> str:
    """The raw volume of the CDMG, digitised from film: pairs of seconds and tenths of g."""
    text = renadic(stated).replace("UNIVERSIDAD DE CHILE - RENADIC", "MADE EARTHQUAKE")
    text = text.replace("PROCESSED: 1/1/11", "PROCESSED: 02/08/94, CDMG QN94A403")
    return text.replace("CHAN  1: EW       (STA CHN:  1)", "CHAN  1:  45 DEG")


def unam_with_blank_block(stated: float = 1.0) -> str:
    """Two channels of twelve: the second block of six stands there and is blank."""
    text = unam(stated).replace("/N45E/V\n", "/N45E/V/ / / /\n").replace(f"/{N}/{N}", f"/{N}/{N}/ / / /")
    blank = "/ / / / / /"
    second = f"ORIENTACION C7-C12 (rumbo;orientacion) : {blank}\nNUM. TOTAL DE MUESTRAS, C7-C12         : {blank}\n"
    return text.replace("INTERVALO DE", f"{second}INTERVALO DE", 1)


def unam_with_repeats(stated: float = 1.0) -> str:
    """The last line stands there three times."""
    text = unam(stated)
    return text + 2 * (text.rstrip("\n").rsplit("\n", 1)[1] + "\n")


def two_headers() -> str:
    """A title with the unit, then number of samples and step, then eight numbers a line: files like KOBE.000."""
    head = f"Kobe 000, acceleration in g\n{N} points, dt = {STEP} sec\n"
    return head + columns(TRUE / 9.80665, 8, "12.7f")


def by_obspy(form: str, values: np.ndarray | None = None, **options) -> bytes:
    """The content of a file that obspy writes: of `values`, or of what every sample file holds."""
    header = {"network": "XX", "station": "MADE", "channel": "HNE", "delta": STEP}
    trace = obspy.Trace(TRUE.astype(np.float32) if values is None else values, header)
    with tempfile.TemporaryDirectory() as folder:  # not every format of obspy is written into memory
        path = Path(folder) / "written"
        trace.write(str(path), format=form, **options)
        return path.read_bytes()


def evt() -> bytes:
    """A file of one channel as a Kinemetrics K2 writes it: a header of 2040 bytes, frames of a tenth of a second."""
    samples = round(0.1 / STEP)
    frames, full_scale, sensitivity = N // samples, 2.5, 1.25
    counts = np.round(TRUE / 9.80665 * sensitivity / full_scale * 2**23).astype(int)
    head = bytearray(2040)
    head[:4] = b"KMI\x09"
    struct.pack_into(">3L4H2L4x2H5s", head, 0x22C, 10**9, 0, frames, 0, 0, 0, 0, 0, 0, 1, 1, b"MADE")
    struct.pack_into(">ff", head, 0x2C8 + 32, full_scale, sensitivity)
    parts = [_tagged(1, bytes(head), b"")]
    for i in range(frames):
        times = 32, 10**9, 1, round(1 / STEP), 128, 0, 100 * i
        frame = struct.pack(">BBHHLHHBBHB13s", 3, 9, 1, *times, 0, b"")
        held = counts[i * samples : (i + 1) * samples]
        body = b"".join(int(count).to_bytes(3, "big", signed=True) for count in held)
        parts.append(_tagged(2, frame, body))
    return b"".join(parts)


def gse() -> bytes:
    """Counts of mm/s² in the lines of GSE2."""
    return by_obspy("GSE2", np.round(1000 * TRUE).astype(np.int32))


def win() -> bytes:
    """One channel in blocks of a second with 32-bit differences, from 1 January 2020 on; the last one is filled up."""
    rate = 10
    counts = np.round(1000 * TRUE).astype(int)
    content = b""
    for second, part in enumerate(counts.reshape(-1, rate)):
        samples = struct.pack(f">{rate}i", part[0], *np.diff(part))
        body = bytes.fromhex(f"2001010000{second:02}") + struct.pack(">HH", 0xA100, 4 << 12 | rate) + samples
        content += struct.pack(">i", 4 + len(body)) + body
    return content


def of_obspy(path: str) -> bytes:
    """The content of a file that obspy installs for its own tests, of a format that it does not write."""
    return (Path(obspy.__file__).parent / "io" / path).read_bytes()


def asdf_station() -> bytes:
    """One processed channel of a workspace of gmprocess, as the archive of its stations gives it."""
    trace = {
        "location": "20", "channel": "HNE", "start_ns": 0, "rate_hz": 1 / STEP, "type": "<f8", "samples": N,
        "unit": "cm/s^2", "high_pass_hz": 0.1, "failure": "",
    }  # fmt: skip
    facts = {"station": "NZ.MADE", "tag": "us1_default", "event": "us1", "traces": [trace]}
    return workspace.packed(facts, b"", (100 * TRUE).astype("<f8").tobytes())


def _tagged(kind: int, head: bytes, body: bytes) -> bytes:
    checksum = sum(head + body) & 0xFFFF
    return struct.pack(">cBBBLHHHH", b"K", 1, 1, 9, kind, len(head), len(body), 1, checksum) + head + body


MADE: dict[str, tuple[Callable[..., str], float, Options]] = {
    "PEER AT2": (peer, 1e-7, Options()),
    "PEER AT2: of 2008": (peer_2008, 1e-7, Options()),
    "COSMOS V1/V2": (cosmos, 1e-7, Options()),
    "CSMIP V1/V2": (csmip, 1e-7, Options()),
    "CSMIP V1/V2: of 1983": (csmip_of_1983, 5e-6, Options()),
    "CSMIP V1/V2: raw": (csmip_raw, 5e-6, Options()),
    "CSMIP V1/V2: film": (csmip_film, 5e-4, Options()),
    "USGS SMC": (smc, 5e-4, Options()),
    "USC Volume 1": (usc, 5e-4, Options()),
    "USC Volume 2": (usc_2, 5e-6, Options()),
    "RENADIC": (renadic, 5e-4, Options()),
    "BHRC": (bhrc, 1e-6, Options()),
    "K-NET/KiK-net": (knet, 2e-6, Options()),
    "DYNA (ESM, ITACA, AFAD)": (dyna, 1e-8, Options()),
    "DYNA (ESM, ITACA, AFAD): filtered anew": (dyna_filtered_anew, 1e-8, Options()),
    "JMA CSV": (jma, 5e-6, Options()),
    "EMOD3D text": (emod3d, 5e-5, Options(unit="g")),
    "AFAD/NSMN text": (afad, 1e-8, Options()),
    "RESORCE": (resorce, 1e-7, Options()),
    "ESD": (esd, 1e-5, Options()),
    "GeoNet V1A/V2A": (geonet, 5e-5, Options()),
    "UNAM/CICESE": (unam, 5e-7, Options()),
    "UNAM/CICESE: blank second block": (unam_with_blank_block, 5e-7, Options()),
    "UNAM/CICESE: repeated last line": (unam_with_repeats, 5e-7, Options()),
    "CWB": (cwb, 5e-6, Options()),
    "CSMNC": (csmnc, 1e-6, Options()),
    "columns of numbers: titled": (titled, 1e-6, Options(unit="m/s2")),
    "columns of numbers: two headers": (two_headers, 5e-7, Options()),
    "columns of numbers": (table, 5e-8, Options()),
}
"""Format, and what is special after a colon → (text of a small file, half a unit of the last digit it prints in m/s²,
what the caller declares)."""

MADE_BINARY: dict[str, tuple[Callable[[], bytes], float, Options]] = {
    "miniSEED": (lambda: by_obspy("MSEED", encoding="FLOAT32"), 1e-7, Options(unit="m/s2")),
    "SAC": (lambda: by_obspy("SAC"), 1e-7, Options(unit="m/s2")),
    "Kinemetrics EVT": (evt, 2e-6, Options()),
    "ASDF station": (asdf_station, 1e-12, Options()),
    "GSE": (gse, 5e-4, Options(unit="mm/s2")),
    "SLIST or TSPAIR": (lambda: by_obspy("SLIST"), 1e-7, Options(unit="m/s2")),
    "SLIST or TSPAIR: pairs": (lambda: by_obspy("TSPAIR"), 1e-7, Options(unit="m/s2")),
}
"""The same for formats that are no text."""

MADE_REFUSED: dict[str, tuple[str, str, str]] = {
    "PEER AT2: VT2": (
        peer().replace("ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY IN CM/S"), "quantity", "velocity",
    ),
}  # fmt: skip
"""Format, and what is special after a colon → (a file of what is no acceleration, the field and value refused)."""


OTHER_KINDS = {
    "spectra": "Response and Fourier Amplitude Spectra\n 1 2 3\n",
    "from_obspy": of_obspy("css/tests/data/test_css.wfdisc").decode(),
    "StationXML": '<?xml version="1.0"?>\n<FDSNStationXML></FDSNStationXML>\n',
}
"""A word of the sentence by which it is refused → a file of no format, which is known all the same."""

OF_OBSPY = {
    "SEISAN": "seisan/tests/data/2011-09-06-1311-36S.A1032_001BH_Z",
    "REFTEK 130": "reftek/tests/data/104800000_000093F8",
    "WIN": "win/tests/data/10030302.00",
}
"""Format → a file that obspy installs, of formats that it does not write: tests/contracts/test_by_obspy.py reads it."""


def format_of(label: str) -> str:
    """Return the name of the format of a label in MADE."""
    return label.partition(":")[0]


def content_of(label: str) -> bytes:
    """Return the content of the file of a label in MADE or MADE_BINARY."""
    made = (MADE | MADE_BINARY)[label][0]()
    return made if isinstance(made, bytes) else made.encode("latin-1")


def read_text(text: str, options: Options | None = None, **declared) -> list[Accelerogram]:
    """Return the channels read from `text`, with what the caller declares."""
    return read_content(text.encode("latin-1"), "made", options or Options(**declared))
