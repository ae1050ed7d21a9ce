// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Conversion.h"

#include "scene/TextReader.h"
#include "tools/import/Framing.h"
#include "tools/import/Model.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace bwfirt {

namespace {

using Corners = Model::Corners;

[[noreturn]] void fail(const ImportSettings& settings, const std::string& what) {
    throw std::runtime_error(settings.model.string() + ": " + what);
}

/// What has to be known of all triangles before the first one can be placed.
struct Survey {
    Imath::Box3d box;
    std::vector<std::size_t> trianglesOf;  ///< by material
    std::size_t triangles = 0;
    std::size_t notFinite = 0;
};

Survey survey(const Model& model, const ImportSettings& settings) {
    Survey result;
    result.trianglesOf.resize(model.materials().size());
    model.forEachTriangle([&](const Corners& corners, std::size_t material) {
        if (material >= result.trianglesOf.size())
            fail(settings, "a mesh refers to a material that is not there");
        ++result.trianglesOf[material];
        ++result.triangles;
        result.notFinite += !std::all_of(corners.begin(), corners.end(), isFinite<double>);
        for (const V3d& corner : corners)
            result.box.extendBy(corner);
    });
    if (result.triangles == 0)
        fail(settings, "holds no triangles");
    if (result.notFinite > 0)
        fail(settings, std::to_string(result.notFinite) + " of its " +
                           std::to_string(result.triangles) +
                           " triangles have an infinite or NaN coordinate");
    if (result.triangles + 2 * settings.lights.size() > std::numeric_limits<std::uint32_t>::max())
        fail(settings, std::to_string(result.triangles) +
                           " triangles are more than indices of 32 bits can tell apart");
    return result;
}

bool emits(const Material& material) {
    return material.radiance > 0 && !material.hasTexture;
}

/// Rounds to single precision, once.
Triangle placed(const Placement& place, const Corners& corners) {
    return {{V3f(place(corners[0])), V3f(place(corners[1])), V3f(place(corners[2]))}};
}

std::array<Corners, 2> squareOf(const SquareLight& light, const V3d& up) {
    const V3d u = light.size / 2 * V3d(up.y, up.z, up.x), v = up.cross(u);
    const V3d& c = light.centre;
    return {{{c - u - v, c + u - v, c + u + v}, {c - u - v, c + u + v, c - u + v}}};
}

/// Places the triangles in the order of Conversion and makes the lights of emissive materials. One
/// all of whose triangles have no area is none.
void placeModel(const Model& model, const Survey& known, Conversion& result) {
    const std::vector<Material>& materials = model.materials();
    std::vector<std::size_t> first(materials.size());  // triangle of each emissive material
    std::size_t end = known.triangles;
    for (std::size_t i = materials.size(); i-- > 0;)
        if (emits(materials[i]))
            first[i] = end -= known.trianglesOf[i];

    std::vector<Triangle>& triangles = result.scene.triangles;
    triangles.resize(known.triangles);
    std::vector<std::size_t> next = first;
    std::size_t nextDark = 0;
    model.forEachTriangle([&](const Corners& corners, std::size_t material) {
        std::size_t& index = emits(materials[material]) ? next[material] : nextDark;
        triangles[index++] = placed(result.placement, corners);
    });

    for (std::size_t i = 0; i < materials.size(); ++i)
        if (std::any_of(triangles.begin() + static_cast<std::ptrdiff_t>(first[i]),
                        triangles.begin() + static_cast<std::ptrdiff_t>(next[i]), hasArea)) {
            result.scene.lights.push_back({static_cast<std::uint32_t>(first[i]),
                                           static_cast<std::uint32_t>(next[i] - 1),
                                           std::numbers::pi * materials[i].radiance});
            result.lightNames.push_back("material '" + printable(materials[i].name) + "'");
        }
}

void addSquareLights(const ImportSettings& settings, Conversion& result) {
    std::vector<Triangle>& triangles = result.scene.triangles;
    for (const SquareLight& square : settings.lights) {
        const auto first = static_cast<std::uint32_t>(triangles.size());
        for (const Corners& corners : squareOf(square, result.up))
            triangles.push_back(placed(result.placement, corners));
        result.scene.lights.push_back({first, first + 1, square.exitance});
        result.lightNames.push_back("--light");
        if (!hasArea(triangles[first]) || !hasArea(triangles[first + 1]))
            fail(settings, "a --light of size " + formatNumber(square.size) +
                               " has no area in single precision at its place in the scene");
    }
}

/// The box of the model and the lights that come to it.
Imath::Box3d boxWithLights(const Conversion& result, const ImportSettings& settings) {
    Imath::Box3d box = result.modelBox;
    for (const SquareLight& light : settings.lights)
        for (const Corners& corners : squareOf(light, result.up))
            for (const V3d& corner : corners)
                box.extendBy(corner);
    return box;
}

bool fitsSinglePrecision(const Imath::Box3d& box) {
    return isFinite(V3f(box.min)) && isFinite(V3f(box.max));
}

}  // namespace

Conversion converted(const Model& model, const ImportSettings& settings) {
    for (const Material& material : model.materials())
        if (!std::isfinite(material.radiance))
            fail(settings, "the emissive colour of the material '" + printable(material.name) +
                               "' is infinite or NaN");
    const Survey known = survey(model, settings);
    Conversion result;
    result.modelBox = known.box;
    result.up = settings.up.value_or(model.up());
    const Imath::Box3d box = boxWithLights(result, settings);
    result.placement = placementFor(box, settings.scale);
    if (!fitsSinglePrecision({result.placement(box.min), result.placement(box.max)}))
        fail(settings, "with this --scale its coordinates exceed the range of single precision");

    result.scene.triangles.reserve(known.triangles + 2 * settings.lights.size());
    placeModel(model, known, result);
    if (model.camera()) {
        result.camera = *model.camera();
        result.camera.position = result.placement(result.camera.position);
        result.hasCameraOfFile = isFinite(V3f(result.camera.position));
    }
    if (!result.hasCameraOfFile)
        result.camera = framingCamera(result.scene.triangles, result.up);
    addSquareLights(settings, result);
    return result;
}

}  // namespace bwfirt
