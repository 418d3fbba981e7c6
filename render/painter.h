#pragma once

#include "render/camera.h"
#include "render/colour_map.h"
#include "render/drawn_scene.h"
#include "render/image.h"

#include <array>
#include <memory>
#include <vector>

namespace weft {

/// What each pixel shows at its centre: the bare value of the cloth there.
struct ValuePicture {
    int width = 0, height = 0;
    std::vector<float> values;       ///< width * height, rows from the top
    std::vector<std::uint8_t> cloth; ///< 1 where the pixel shows cloth
};

struct PainterParams {
    std::array<int, 2> size{1280, 720}; ///< pixels
    int supersample = 2;                ///< per axis, 1..4
    bool edges = true;                  ///< mesh lines on cloth
    ColourScale scale;
    Camera camera;
};

/// Turns a scene into light and light into pixels: the OpenGL context, its programs and buffers,
/// and the order of the passes.
class Painter {
public:
    /// Throws Error (Disk) when OpenGL refuses.
    explicit Painter(const PainterParams& params);
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// The picture without legend. `values`, when not null, is filled too.
    Image paint(const DrawnScene& scene, ValuePicture* values);

private:
    struct Buffers;
    PainterParams params_;
    std::unique_ptr<Buffers> buffers_;
};

} // namespace weft
