#pragma once

#include "frames/frame.h"
#include "render/camera.h"
#include "render/colour_map.h"
#include "render/image.h"
#include "render/painter.h"
#include "scene/params.h"

#include <array>
#include <memory>

namespace weft {

/// What a picture shows, counted one sample a pixel (at its centre) from the values themselves,
/// not from colours; the legend hides nothing here.
struct PictureStats {
    double covered_share = 0.0; ///< pixels that show cloth over all pixels
    double above_share = 0.0;   ///< covered pixels above the range over covered pixels
    double below_share = 0.0;   ///< the same below the range
    std::array<double, 3>
        mean_colour{}; ///< mean of the finished picture's bytes with the legend; 0..1
};

/// Counts the values; mean_colour stays zero.
PictureStats count_values(const ValuePicture& values, const ColourScale& scale);

/// Mean of a picture's bytes, 0..1.
std::array<double, 3> mean_colour(const Image& image);

/// Draws frames of one run. Everything that must stay still over the sequence is fixed here: size,
/// camera, colours, floor.
class Renderer {
public:
    /// @param params  of the scene; its camera is used when has_camera, else frame_camera(motion);
    ///                its range when has_range, else `range`
    /// @param motion  what the whole sequence moves in; camera, floor and light are fitted to it
    /// @param range   used when the scene gives none, in the quantity's unit
    /// Throws Error (Disk) when OpenGL refuses, (BadInput) naming an unknown map or quantity.
    Renderer(const RenderParams& params, const Extent& motion, const Vec2& range);

    /// The picture of a frame; the same bytes for the same frame, whatever was drawn before and on
    /// however many threads. May be called from any thread, one at a time.
    Image draw(const Frame& frame, PictureStats* stats = nullptr);

    const ColourScale& scale() const { return scale_; }
    const Camera& camera() const { return camera_; }

private:
    RenderParams params_;
    Box3 bounds_;
    int quantity_;
    ColourScale scale_;
    Camera camera_;
    std::unique_ptr<Painter> painter_;
};

} // namespace weft
