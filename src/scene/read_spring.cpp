#include "scene/law_shape.h"
#include "scene/read_parts.h"

#include <fmt/core.h>

namespace weft {
namespace {

/// Keys that would silently do nothing where the user expects them to hold.
void refuse_unused(TomlTable& spring, Model model, SpringOwner owner) {
    if (model == Model::StvkTriangle && spring.has("limit")) {
        spring.fail("limit", "must be left out: stvk_triangle has no edges to limit");
    }
    if (owner == SpringOwner::Solid) {
        for (const char* key : {"bend", "calibrate"}) {
            if (spring.has(key)) {
                spring.fail(key, "must be left out: of cloth only");
            }
        }
    }
}

} // namespace

void read_model(TomlTable& owner, Model& model, SpringOwner kind) {
    if (kind == SpringOwner::Cloth) {
        owner.read_choice("model", model,
                          {{"corotational", Model::Corotational},
                           {"cubic", Model::Cubic},
                           {"linear", Model::Linear},
                           {"stvk_edge", Model::StvkEdge},
                           {"stvk_triangle", Model::StvkTriangle}});
    } else {
        owner.read_choice(
            "model", model,
            {{"cubic", Model::Cubic}, {"linear", Model::Linear}, {"stvk_edge", Model::StvkEdge}});
    }
}

void read_spring(TomlTable& owner, Model model, SpringParams& params, SpringOwner kind) {
    if (!owner.has("spring")) {
        return;
    }
    TomlTable spring = owner.table("spring");
    if (model == Model::Corotational) {
        spring.fail("is of edge models: needs model = \"cubic\", \"linear\", \"stvk_edge\" or "
                    "\"stvk_triangle\"");
    }
    spring.read("K", params.K);
    spring.read("K1", params.K1);
    spring.read("K2", params.K2);
    spring.read("a1", params.a1);
    spring.read("a2", params.a2);
    spring.read("bend", params.bend);
    spring.read("shear", params.shear);
    spring.read("damping", params.damping);
    spring.read("jacobian_damping", params.jacobian_damping);
    spring.read("limit", params.limit);
    spring.read("mass", params.mass);
    spring.read("strict", params.strict);
    spring.read("calibrate", params.calibrate);
    refuse_unused(spring, model, kind);
    spring.finish();
    spring.refuse(problem(params));
    if (const std::string text = softening_text(model, params); params.strict && !text.empty()) {
        spring.fail("strict", "refuses this law: " + text);
    }
}

} // namespace weft
