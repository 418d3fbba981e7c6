#pragma once

#include "scene/mesh_file.h"
#include "scene/mesh_import.h"

namespace weft {

/// Numbered files, one a pose.
struct SequenceFiles {
    std::vector<std::filesystem::path> files; ///< by ascending number
    std::vector<std::string> names;           ///< in messages, as the scene writes them
};

/// The files of a pattern: `body.####.obj` stands for body.0001.obj, body.0002.obj ...; as many
/// digits as marks, or one mark for numbers without leading zeros.
///
/// @param base_dir  what the pattern is relative to
/// Throws Error (BadInput), one line, when the pattern has no marks or more than one group of
/// them, when no file fits, or when a number in between is missing.
SequenceFiles find_sequence(const std::filesystem::path& base_dir, const std::string& pattern);

/// Reads further poses of a mesh from files that have the same objects and triangles.
class SequenceReader {
public:
    /// @param source  as the first file was read with
    /// @param first   what import_mesh made of files[0]
    SequenceReader(SequenceFiles files, const MeshSource& source, const ImportedMesh& first);

    /// Positions in the file's unit and axes of the vertices (#V) that `first` has.
    /// Throws Error (BadInput), naming file and counts, when the mesh is another one than the
    /// first file's or has a coordinate that is not finite.
    void read(std::size_t k, std::vector<Vec3f>& positions) const;

    std::size_t count() const { return files_.files.size(); }

private:
    MeshFile read_file(std::size_t k) const;
    void check_same(const MeshFile& file, std::size_t k) const;

    SequenceFiles files_;
    MeshSource source_;
    std::vector<SourceVertex> vertices_;
    std::vector<std::size_t> vertex_counts_;             ///< by object of the first file
    std::vector<std::vector<Triangle>> first_triangles_; ///< likewise
};

} // namespace weft
