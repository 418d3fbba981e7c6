#include "scene/joined_mesh.h"
#include "scene/mesh_import.h"
#include "scene/rig_pose.h"
#include "support/real_models.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <numbers>

namespace weft {

namespace {

constexpr double k_quarter_turn = 0.5 * std::numbers::pi;

Eigen::Quaterniond about_z(double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

NodeChannel
channel_of(Index node, const Vec3& translation, KeyFrames<Eigen::Quaterniond> rotation) {
    return {.node = node,
            .translation = {{0.0}, {translation}},
            .rotation = std::move(rotation),
            .scale = {{0.0}, {Vec3::Ones()}}};
}

/// A cylinder about y from 0 to 2 m with a bone in each half; the upper one bends by a quarter turn
/// about z, the joint at y = 1, within 1 s. Vertices at the joint hang on both alike.
struct BentCylinder {
    Rig rig;
    Animation animation;
    std::vector<SourceVertex> vertices;

    BentCylinder() {
        Affine joint = Affine::Identity();
        joint.translation() = Vec3(0.0, 1.0, 0.0);
        rig.nodes = {{"root", k_no_index, Affine::Identity()},
                     {"lower", 0, Affine::Identity()},
                     {"upper", 1, joint}};
        RigPart part;
        part.bones = {{1, Affine::Identity()}, {2, joint.inverse()}};
        part.influence_begin.push_back(0);
        for (int ring = 0; ring <= 4; ++ring) {
            for (int side = 0; side < 8; ++side) {
                const double angle = k_quarter_turn * side / 2.0;
                part.positions.emplace_back(0.2 * std::cos(angle), 0.5 * ring,
                                            0.2 * std::sin(angle));
                const double upper = ring < 2 ? 0.0 : ring == 2 ? 0.5 : 1.0;
                part.influences.push_back({0, 1.0 - upper});
                part.influences.push_back({1, upper});
                part.influence_begin.push_back(static_cast<Index>(part.influences.size()));
                vertices.push_back({0, static_cast<Index>(vertices.size())});
            }
        }
        rig.parts.push_back(part);
        animation.channels.push_back(channel_of(
            2, joint.translation(), {{0.0, 1.0}, {about_z(0.0), about_z(k_quarter_turn)}}));
        animation.duration = 1.0;
    }

    std::vector<Vec3> at(double t) const {
        std::vector<Vec3> positions(vertices.size());
        pose_vertices(rig, animation, t, vertices, positions);
        return positions;
    }
};

/// Greatest difference of distances between vertices, as far as a rigid motion keeps them.
double rigidity_error(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); i += 7) {
        for (std::size_t j = 0; j < i; j += 13) {
            worst = std::max(worst, std::abs((a[i] - a[j]).norm() - (b[i] - b[j]).norm()));
        }
    }
    return worst;
}

ImportedMesh import_model(const std::string& name) {
    return import_mesh(test::k_real_models / name, {.repair = true}, false);
}

std::vector<Vec3> pose_model(const ImportedMesh& mesh, const std::string& animation, double t) {
    std::vector<Vec3> positions(mesh.sources.size());
    pose_vertices(*mesh.rig, *choose_animation(mesh, animation, "model"), t, mesh.sources,
                  positions);
    for (Vec3& x : positions) {
        x = (mesh.to_world * x).eval();
    }
    return positions;
}

/// Units, axes and a triangle, up to the properties of its joint, in ASCII FBX.
constexpr const char* k_flap_fbx = R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {
FBXHeaderVersion: 1003
FBXVersion: 7300
}
GlobalSettings:  {
Version: 1000
Properties70:  {
P: "UpAxis", "int", "Integer", "",1
P: "UpAxisSign", "int", "Integer", "",1
P: "FrontAxis", "int", "Integer", "",2
P: "FrontAxisSign", "int", "Integer", "",1
P: "CoordAxis", "int", "Integer", "",0
P: "CoordAxisSign", "int", "Integer", "",1
P: "UnitScaleFactor", "double", "Number", "",100
}
}
Objects:  {
Geometry: 1000, "Geometry::Flap", "Mesh" {
Vertices: *9 {
a: 0,0,0,1,0,0,0,1,0
}
PolygonVertexIndex: *3 {
a: 0,1,-3
}
GeometryVersion: 124
}
Model: 2000, "Model::Flap", "Mesh" {
Version: 232
Properties70:  {
P: "PreRotation", "Vector3D", "Vector", "",0,0,90
)";

/// The rest of the joint.
constexpr const char* k_joint_fbx = R"(
P: "RotationActive", "bool", "", "",1
}
Shading: T
Culling: "CullingOff"
}
)";

/// A quarter turn within 1 s, and what belongs to what.
constexpr const char* k_turn_fbx = R"(AnimationStack: 3000, "AnimStack::Take", "" {
Properties70:  {
P: "LocalStop", "KTime", "Time", "",46186158000
}
}
AnimationLayer: 3100, "AnimLayer::Base", "" {
}
AnimationCurveNode: 3200, "AnimCurveNode::R", "" {
Properties70:  {
P: "d|X", "Number", "", "A",0
}
}
AnimationCurve: 3300, "AnimCurve::", "" {
Default: 0
KeyVer: 4008
KeyTime: *2 {
a: 0,46186158000
}
KeyValueFloat: *2 {
a: 0,90
}
KeyAttrFlags: *1 {
a: 24836
}
KeyAttrDataFloat: *4 {
a: 0,0,0,0
}
KeyAttrRefCount: *1 {
a: 2
}
}
}
Connections:  {
C: "OO",2000,0
C: "OO",1000,2000
C: "OO",3100,3000
C: "OO",3200,3100
C: "OP",3200,2000, "Lcl Rotation"
C: "OP",3300,3200, "d|X"
})";

/// A triangle whose joint is oriented by a quarter turn about z before it turns by a quarter about
/// x within 1 s; in ASCII FBX, with further properties of the joint.
std::string oriented_fbx(const std::string& properties) {
    return k_flap_fbx + properties + k_joint_fbx + k_turn_fbx;
}

} // namespace

TEST(Rig, BindPoseIsTheMesh) {
    const BentCylinder cylinder;

    const std::vector<Vec3> positions = cylinder.at(0.0);

    for (std::size_t v = 0; v < positions.size(); ++v) {
        EXPECT_LT((positions[v] - cylinder.rig.parts[0].positions[v]).norm(), 1e-14);
    }
}

TEST(Rig, BendsACylinderByItsUpperBone) {
    const BentCylinder cylinder;
    const auto& rest = cylinder.rig.parts[0].positions;
    const Vec3 joint(0.0, 1.0, 0.0);

    for (const double t : {0.25, 0.5, 1.0, 7.0}) {
        const std::vector<Vec3> positions = cylinder.at(t);
        const double angle = std::min(t, 1.0) * k_quarter_turn;
        for (std::size_t v = 0; v < rest.size(); ++v) {
            const Vec3 r = rest[v] - joint;
            const Vec3 turned(std::cos(angle) * r.x() - std::sin(angle) * r.y(),
                              std::sin(angle) * r.x() + std::cos(angle) * r.y(), r.z());
            const double upper = v < 16 ? 0.0 : v < 24 ? 0.5 : 1.0;
            const Vec3 expected = joint + (1.0 - upper) * r + upper * turned;
            EXPECT_LT((positions[v] - expected).norm(), 1e-14) << t << " " << v;
        }
    }
}

TEST(Rig, NodesBelowAMovedOneMoveWithIt) {
    BentCylinder cylinder;
    cylinder.animation.channels = {
        channel_of(1, Vec3(0.0, 0.0, 3.0), {{0.0}, {about_z(k_quarter_turn)}})};

    const std::vector<Vec3> positions = cylinder.at(0.0);

    const auto& rest = cylinder.rig.parts[0].positions;
    for (std::size_t v = 0; v < rest.size(); ++v) {
        const Vec3 expected(-rest[v].y(), rest[v].x(), rest[v].z() + 3.0);
        EXPECT_LT((positions[v] - expected).norm(), 1e-14);
    }
}

TEST(Rig, MorphTargetsBlendBeforeBones) {
    BentCylinder cylinder;
    MorphTarget wide{"wide", 0.0, cylinder.rig.parts[0].positions};
    for (Vec3& x : wide.positions) {
        x.x() *= 2.0;
        x.z() *= 2.0;
    }
    cylinder.rig.parts[0].targets = {wide, wide};
    cylinder.animation.morphs = {{0, {{0.0, 1.0}, {{0.0, 0.0}, {0.5, 0.25}}}}};

    const Vec3 top = cylinder.at(1.0)[32]; // rest at (0.2, 2, 0), wider by 0.75

    EXPECT_LT((top - Vec3(-1.0, 1.0 + 0.2 * 1.75, 0.0)).norm(), 1e-14);
}

TEST(Rig, KeysAreConstantOutsideAndTurnTheShorterWayAtConstantSpeed) {
    const Eigen::Quaterniond end = about_z(1.0);
    const KeyFrames<Eigen::Quaterniond> keys{
        {1.0, 3.0}, {about_z(0.0), Eigen::Quaterniond(-end.coeffs())}}; // the same rotation

    for (const auto& [t, angle] : std::vector<std::pair<double, double>>{
             {0.0, 0.0}, {1.0, 0.0}, {1.5, 0.25}, {2.0, 0.5}, {3.0, 1.0}, {9.0, 1.0}}) {
        const Vec3 x = value_at(keys, t) * Vec3::UnitX();
        EXPECT_LT((x - Vec3(std::cos(angle), std::sin(angle), 0.0)).norm(), 1e-14) << t;
    }
}

TEST(Rig, SeesWhichVerticesAnAnimationMoves) {
    BentCylinder cylinder;
    EXPECT_TRUE(animates(cylinder.rig, cylinder.animation, cylinder.vertices));

    cylinder.rig.nodes.push_back({"camera", 0, Affine::Identity()});
    cylinder.animation.channels[0].node = 3;

    EXPECT_FALSE(animates(cylinder.rig, cylinder.animation, cylinder.vertices));
}

TEST(Rig, PartsThatMoveApartAreNotSewnWhereTheyMeet) {
    // Two triangles with a common edge: as parts of one node they share two vertices, not so when
    // one turns.
    Rig rig;
    rig.nodes = {{"root", k_no_index, Affine::Identity()},
                 {"frame", 0, Affine::Identity()},
                 {"door", 0, Affine::Identity()}};
    rig.parts.resize(2);
    rig.parts[0].node = 1;
    rig.parts[1].node = 2;
    const auto welded = [&] {
        JoinedMesh joined;
        joined.mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
        joined.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
        joined.sources = {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}};
        weld_mesh(joined, 1e-6, motion_groups(rig));
        return joined;
    };
    EXPECT_EQ(welded().mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}}));
    EXPECT_EQ(welded().sources[3], (SourceVertex{1, 2}));

    rig.animations.push_back({.name = "open"});
    rig.animations[0].channels = {channel_of(2, Vec3::Zero(), {{0.0}, {about_z(0.0)}})};
    EXPECT_EQ(welded().mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));

    rig.parts[0].bones = rig.parts[1].bones = {{1, Affine::Identity()}};
    EXPECT_EQ(welded().mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}}));
}

TEST(Rig, FingerprintTellsEveryKey) {
    BentCylinder cylinder;
    const std::uint64_t before = fingerprint(cylinder.rig, cylinder.animation);
    EXPECT_EQ(before, fingerprint(BentCylinder().rig, BentCylinder().animation));

    cylinder.animation.channels[0].rotation.values[1] = about_z(k_quarter_turn + 1e-15);

    EXPECT_NE(before, fingerprint(cylinder.rig, cylinder.animation));
}

TEST(Rig, FbxJointsTurnInTheirOrientationAndAboutTheirPivot) {
    const test::TempFolder folder;
    for (const Vec3& pivot : {Vec3(0.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)}) {
        const std::string property =
            pivot.isZero() ? "" : "P: \"RotationPivot\", \"Vector3D\", \"Vector\", \"\",0,1,0";
        test::write_file(folder / "flap.fbx", oriented_fbx(property));
        const ImportedMesh mesh = import_mesh(folder / "flap.fbx", {}, false);

        for (const double t : {0.0, 1.0}) {
            const Mat3 turn = (Eigen::AngleAxisd(k_quarter_turn, Vec3::UnitZ()) *
                               Eigen::AngleAxisd(t * k_quarter_turn, Vec3::UnitX()))
                                  .toRotationMatrix();
            const std::vector<Vec3> positions = pose_model(mesh, "", t);
            for (std::size_t v = 0; v < 3; ++v) {
                const Vec3 rest(v == 1 ? 1.0 : 0.0, v == 2 ? 1.0 : 0.0, 0.0);
                const Vec3 expected = pivot + turn * (rest - pivot);
                EXPECT_LT((positions[v] - expected).norm(), 1e-6) << pivot.y() << " " << t;
            }
        }
    }
}

TEST(RealRigs, SkinnedStripOfTheGltfTutorialBendsAsItSays) {
    // Joint 1 stands 1 m above joint 0, x is shifted by -0.5 in the bind pose, and from 1 s to
    // 1.5 s it is turned by a quarter about z.
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh mesh = import_model("glTF2/simple_skin/simple_skin.gltf");

    const std::vector<Vec3> positions = pose_model(mesh, "", 1.25);

    int tops = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const Vec3& rest = mesh.mesh.positions[v];
        if (rest.y() == 2.0) { // on joint 1 alone
            ++tops;
            EXPECT_LT((positions[v] - Vec3(-1.0, 1.0 + rest.x() - 0.5, 0.0)).norm(), 1e-6);
        }
        if (rest.y() == 0.0) { // on joint 0 alone
            EXPECT_LT((positions[v] - (rest - Vec3(0.5, 0.0, 0.0))).norm(), 1e-6);
        }
    }
    EXPECT_EQ(tops, 2);
}

TEST(RealRigs, BindPosesAreTheMeshUpToARigidMotion) {
    WEFT_NEEDS_REAL_MODELS();
    struct Model {
        const char* name;
        const char* animation;
    };
    for (const auto& [name, animation] :
         {Model{"X/Testwuson.X", "Wuson_Bind"}, Model{"FBX/huesitos.fbx", ""},
          Model{"FBX/animation_with_skeleton.fbx", ""},
          Model{"glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", ""}}) {
        const ImportedMesh mesh = import_model(name);
        const std::vector<Vec3> positions = pose_model(mesh, animation, 0.0);
        EXPECT_LT(rigidity_error(mesh.mesh.positions, positions), 1e-4) << name;
    }
}

TEST(RealRigs, RunningBullKeepsItsFeetNearTheGround) {
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh bull = import_model("X/Testwuson.X");

    for (int k = 0; k <= 10; ++k) {
        const std::vector<Vec3> positions = pose_model(bull, "Wuson_Run", 0.0966 * k);
        Eigen::AlignedBox3d box;
        for (const Vec3& x : positions) {
            box.extend(x);
        }
        EXPECT_NEAR(box.min().y(), 0.0, 0.06) << k;
        EXPECT_NEAR(box.max().y(), 1.52, 0.03) << k; // as high as it is modelled
    }
}

TEST(RealRigs, UnknownAnimationIsRefusedWithThoseThatAreThere) {
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh bull = import_model("X/Testwuson.X");
    EXPECT_EQ(choose_animation(bull, "none", "bull.x"), nullptr);
    try {
        choose_animation(bull, "Run", "bull.x");
        FAIL();
    } catch (const std::exception& error) {
        EXPECT_STREQ(error.what(), "bull.x: animation = \"Run\": not in the file; it has "
                                   "\"Wuson_Run\", \"Wuson_Walk\", \"Wuson_Bind\"");
    }
}

} // namespace weft
