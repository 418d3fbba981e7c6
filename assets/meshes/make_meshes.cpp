// Writes the meshes that the project ships: `make_meshes OUTDIR`, or examines written ones:
// `make_meshes --check DIR`. Same machine code, same files: no randomness, no threads, no clock.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>

#include "body_field.h"
#include "check.h"
#include "garments.h"
#include "isosurface.h"
#include "plate.h"
#include "rabbit.h"
#include "remesh.h"

namespace weft {
namespace {

ObjMesh make_mannequin() {
    const Field mirror = [](const Vec3& p) { return -p.x(); };
    // Hands and feet are thin and need smaller triangles.
    const Field edge_length = [](const Vec3& p) {
        constexpr double k_body = 0.0200; // m
        constexpr double k_foot = 0.0148; // m
        constexpr double k_hand = 0.0125; // m
        return p.x() > 0.46 ? k_hand : p.y() < 0.08 ? k_foot : k_body;
    };
    Patch patch = extract_isosurface(body_field, {-0.0057, -0.03, -0.20}, {0.66, 1.80, 0.25}, 0.01);
    patch = largest_part(clip(patch, mirror, 1U));
    remesh(patch, body_field, {mirror}, edge_length);
    patch = mirror_x(patch, 1U);
    return {patch.vertices, patch.triangles, {}, {}};
}

void write_garment(const std::filesystem::path& path, const Garment& garment) {
    write_obj(path, {garment.patch.vertices, garment.patch.triangles, garment.pattern.positions,
                     garment.pattern.triangles});
    std::printf("%-16s %6zu triangles, pattern stretched %.1f %% on average, %.0f %% at worst\n",
                path.filename().c_str(), garment.patch.triangles.size(),
                100.0 * garment.pattern.distortion.mean, 100.0 * garment.pattern.distortion.worst);
    std::fflush(stdout);
}

void write_all(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write_obj(folder / "mannequin.obj", make_mannequin());
    write_garment(folder / "skirt.obj", make_skirt());
    write_garment(folder / "tshirt.obj", make_tshirt());
    write_garment(folder / "dress.obj", make_dress());
    write_garment(folder / "tablecloth.obj", make_tablecloth());
    write_garment(folder / "flag.obj", make_flag());
    write_obj(folder / "plate_with_hole.obj", make_plate_with_hole());
    write_obj(folder / "rabbit.obj", make_rabbit());
}

} // namespace
} // namespace weft

int main(int argc, char** argv) {
    try {
        if (argc == 3 && std::string_view(argv[1]) == "--check")
            return weft::check_meshes(argv[2]) ? 0 : 1;
        if (argc == 2 && argv[1][0] != '-') {
            weft::write_all(argv[1]);
            return 0;
        }
        std::fputs("usage: make_meshes OUTDIR\n       make_meshes --check DIR\n", stderr);
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_meshes: %s\n", error.what());
        return 1;
    }
}
