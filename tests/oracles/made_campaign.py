"""A small shake-table campaign of known outcome, in the documented form of the real one, but for the meshes."""

import hashlib
from pathlib import Path

import numpy as np

PEAKS = (0.08, 0.2, 0.5, 0.9)
"""g; each motion is played at each of them."""
OVERTURNS = (0.4, 0.6)
"""g; peak above which the first and the second specimen overturn."""
_COLUMNS = "test,n,dt,motion,pgv_over_pga,pga_g,overturned_specimen_1,overturned_specimen_2,specimen_1_dem_a"


def made_motion(seed: int, peak: float) -> np.ndarray:
    """float32, g, at 200 Hz, with an offset of the sensor."""
    draw, times = np.random.default_rng(seed), np.arange(1600) / 200
    tones = sum(
        draw.normal() * np.sin(2 * np.pi * f * times + draw.uniform(0, 7)) / f for f in (0.5, 0.9, 1.7)
    )
    values = np.sin(np.pi * times / 8) ** 2 * tones
    return (values * peak / np.abs(values).max() + 0.01).astype(np.float32)


def write_campaign(folder: Path, catalogue: Path, tests: int) -> None:
    """Write tests.csv and accelerations.npz into `folder`, and the catalogue of the table motions."""
    rows, arrays, listed = [_COLUMNS], {}, ["test,source_path,samples,samples_sha256"]
    for k in range(tests):
        peak = PEAKS[k % len(PEAKS)]
        motion = k // len(PEAKS)
        samples = arrays[f"{k + 1:03d}"] = made_motion(motion, peak)
        sha256 = hashlib.sha256(samples.tobytes()).hexdigest()
        listed.append(f"{k + 1},Test{k + 1:03d}.txt,{samples.size},{sha256}")
        fell = ",".join(str(int(peak > limit)) for limit in OVERTURNS)
        rows.append(f"{k + 1},{samples.size},0.005,motion_{motion},0.1,{peak},{fell},1")
    (folder / "tests.csv").write_text("\n".join(rows) + "\n")
    np.savez(folder / "accelerations.npz", **arrays)
    catalogue.write_text("\n".join(listed) + "\n")
