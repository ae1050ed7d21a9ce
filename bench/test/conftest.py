# SPDX-License-Identifier: GPL-3.0-only
"""Lets the tests import the modules of bench.py."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
