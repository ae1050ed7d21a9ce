# SPDX-License-Identifier: GPL-3.0-only
"""What grows and lies in the forest. One unit is half a metre; the path leads towards -z."""
