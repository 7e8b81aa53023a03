"""Random wrong values, orders of calls, interrupts and copies, different in each run, never crash the interpreter."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

# A failure names its seed; with this seed in SKEIN_FUZZ_SEED, the tests draw the same values.
SEED = int(os.environ.get("SKEIN_FUZZ_SEED") or random.SystemRandom().randrange(1 << 32))


@pytest.mark.parametrize("seed", [SEED])
@pytest.mark.parametrize("what", ["fleet", "interrupts", "results", "programs"])
def test_no_misuse_crashes_the_interpreter(what: str, seed: int, root: Path, tmp_path: Path) -> None:
    fuzz = Path(__file__).with_name("fuzz.py")
    done = subprocess.run([sys.executable, "-B", "-W", "error::ResourceWarning", fuzz, what, str(seed)], cwd=tmp_path,
                          env={**os.environ, "PYTHONPATH": str(root / "python"), "MPLBACKEND": "Agg"},
                          capture_output=True, text=True)
    assert done.returncode == 0, (f"SKEIN_FUZZ_SEED={SEED}: {what} with seed {seed} ended with {done.returncode}\n"
                                  + done.stderr[-3000:])
    assert "refused" in done.stdout
