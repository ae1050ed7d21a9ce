# SPDX-License-Identifier: GPL-3.0-only
"""The modelling library of the generators."""

import numpy as np
import pytest

from edges import open_edges
from model import meshes, noise, portable, shapes, vectors


def volume(mesh: np.ndarray) -> float:
    """Enclosed by a closed surface; positive where corners run counterclockwise from outside."""
    return float(vectors.dot(mesh[:, 0], vectors.cross(mesh[:, 1], mesh[:, 2])).sum() / 6)


@pytest.mark.parametrize('function, low, high', [
    ('sin', -50, 50), ('cos', -50, 50), ('exp', -20, 20), ('log', 1e-6, 1e6)])
def test_elementary_functions_agree_with_numpy(function: str, low: float, high: float) -> None:
    x = np.linspace(low, high, 100_001)
    expected = getattr(np, function)(x)
    error = np.abs(getattr(portable, function)(x) - expected)
    assert (error <= 1e-14 * np.maximum(1, np.abs(expected))).all()


def test_powers_agree_with_numpy_and_keep_zero() -> None:
    x = np.linspace(0, 10, 1001)
    assert portable.power(x, 1.7) == pytest.approx(x**1.7, rel=1e-13, abs=0)


def test_quarter_turns_are_exact() -> None:
    angle = np.arange(-4, 5) * (portable.PI / 2)
    assert np.array_equal(portable.sin(angle), [0, 1, 0, -1, 0, 1, 0, -1, 0])
    assert np.array_equal(portable.cos(angle), [1, 0, -1, 0, 1, 0, -1, 0, 1])


def test_random_numbers_are_the_same_for_ever() -> None:
    random = portable.Random(1)
    assert random.uniform(0, 1, 3).tolist() == [0.417022004702574, 0.7203244934421581,
                                                0.00011437481734488664]


def test_random_numbers_have_their_distribution() -> None:
    random = portable.Random(1)
    normal = random.normal(100_000)
    assert abs(normal.mean()) < 5 / np.sqrt(100_000)
    assert abs(normal.std() - 1) < 5 / np.sqrt(200_000)
    assert sorted(set(random.integers(5, 1000).tolist())) == [0, 1, 2, 3, 4]
    direction = random.direction(10_000)
    assert vectors.length(direction) == pytest.approx(1)
    assert np.abs(direction.mean(axis=0)).max() < 5 / np.sqrt(30_000)


SOLIDS = {
    'box': (shapes.box((0, 0, 0), (1, 2, 3)), 6),
    'cylinder': (shapes.cylinder(2, 0, 3, 256), 12 * np.pi),
    'sphere': (shapes.sphere(3, 256), 36 * np.pi),
    'rounded box': (shapes.rounded_box((0, 0, 0), (3, 4, 5), 1, 64), 28 + 22 / 3 * np.pi),
    'L extruded': (shapes.extruded([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0),
                                    (0, 2, 0)], (0, 0, 2)), 6),
    'tubes': (shapes.tubes([[(0, 0, 0), (0, 1, 0), (0, 2, 0)], [(5, 0, 0), (6, 0, 0), (7, 0, 0)]],
                           [[1, 1, 1], [0.5, 0.5, 0.5]], 256), 2.5 * np.pi),
}


@pytest.mark.parametrize('name', SOLIDS)
def test_solids_are_closed_and_have_their_volume(name: str) -> None:
    mesh, expected = SOLIDS[name]
    assert open_edges(mesh) == 0
    assert volume(mesh) == pytest.approx(expected, rel=2e-3)


def test_a_bent_tube_is_closed_and_as_thick_as_asked() -> None:
    path = shapes.spline([(0, 0, 0), (0, 2, 0), (2, 3, 0), (2, 3, 4)], 60)
    mesh = shapes.tubes(path, 0.1, 12)
    assert open_edges(mesh) == 0
    steps = vectors.length(path[1:] - path[:-1]).sum()
    assert volume(mesh) == pytest.approx(0.1**2 * 12 / 2 * np.sin(np.pi / 6) * steps, rel=0.02)


def test_a_polygon_that_is_not_convex_keeps_its_area() -> None:
    star = [(np.cos(a) * r, 0, -np.sin(a) * r)
            for a, r in zip(np.arange(10) * np.pi / 5, [2, 1] * 5)]
    mesh = shapes.polygon(star)
    normals = vectors.cross(mesh[:, 1] - mesh[:, 0], mesh[:, 2] - mesh[:, 0])
    assert (normals[:, 1] > 0).all()
    assert normals[:, 1].sum() / 2 == pytest.approx(10 * 2 * 1 * np.sin(np.pi / 5) / 2)


def test_a_polygon_that_crosses_itself_is_refused() -> None:
    with pytest.raises(ValueError, match='crosses itself'):
        shapes.polygon([(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)])


def test_a_spline_passes_through_its_points() -> None:
    points = np.array([(0, 0, 0), (1, 2, 0), (3, 1, 1), (4, 4, 4)], dtype=float)
    assert shapes.spline(points, 10)[::3] == pytest.approx(points)


def test_copies_are_turned_and_moved() -> None:
    mesh = np.array([[(1, 0, 0), (0, 1, 0), (0, 0, 1)]], dtype=float)
    turn = vectors.rotation(np.array([meshes.Z, meshes.Z]), np.array([0, portable.PI / 2]))
    copies = meshes.repeated(mesh, turn, np.array([(0, 0, 5), (10, 0, 0)]))
    assert copies == pytest.approx(np.array([[(1, 0, 5), (0, 1, 5), (0, 0, 6)],
                                             [(10, 1, 0), (9, 0, 0), (10, 0, 1)]], dtype=float))


def test_noise_is_smooth_and_differs_with_the_seed() -> None:
    points = portable.Random(1).uniform(-20, 20, (10_000, 3))
    value = noise.gradient_noise(points)
    assert np.abs(value).max() <= 1.1 and value.std() > 0.2
    assert np.abs(noise.gradient_noise(points + 1e-6) - value).max() < 1e-5
    assert np.abs(noise.gradient_noise(points, seed=1) - value).max() > 0.5
    assert noise.gradient_noise(np.floor(points)) == pytest.approx(0)
