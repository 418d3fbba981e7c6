#pragma once

#include "flatten.h"
#include "patch.h"

namespace weft {

/// A piece of cloth with its flat pattern.
struct Garment {
    Patch patch;
    FlatPattern pattern;
};

/// A flared knee-length skirt, one panel, seam down the back. The top border is the waistband.
Garment make_skirt();

/// A loose T-shirt with short sleeves, front and back panel. It is worn over the skirt.
Garment make_tshirt();

/// A sleeveless flared dress, front and back panel. It is worn alone.
Garment make_dress();

/// Round, 1.4 m across, in the plane y = 0, facing up.
Garment make_tablecloth();

/// 1.5 m × 0.9 m in the plane z = 0, facing +z; the pole is at x = 0.
Garment make_flag();

} // namespace weft
