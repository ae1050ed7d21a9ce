# SPDX-License-Identifier: GPL-3.0-only
"""What the generators of the standard scenes share.

A mesh is an array of float64 of the shape (triangles, 3 corners, 3 coordinates).

The same bytes have to come out on every machine. So these modules, and the generators, do without
the functions whose last bit depends on the processor or the library: sine, exponential and the like
of numpy and math, products of matrices, sums and means. The modules `portable` and `vectors` stand
in for them.
"""
