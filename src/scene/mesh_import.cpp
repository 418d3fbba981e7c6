#include "scene/mesh_import.h"

#include "base/error.h"
#include "scene/mesh_assembly.h"
#include "scene/object_choice.h"

namespace weft {

ImportedMesh import_mesh(const std::filesystem::path& file, const MeshSource& source, bool cloth) {
    const std::string name = source.file.empty() ? file.string() : source.file;
    const MeshFile read = read_mesh_file(file, name);
    MeshAssembly assembly =
        assemble_mesh(read, choose_objects(read, source.objects, name), source, name);
    if (cloth) {
        assembly.refusals.insert(assembly.refusals.end(), assembly.cloth_refusals.begin(),
                                 assembly.cloth_refusals.end());
    }
    if (assembly.refusals.size() == 1) {
        fail_input("{}", assembly.refusals[0]);
    }
    if (!assembly.refusals.empty()) {
        fail_input("{} (and {} more: see weft inspect)", assembly.refusals[0],
                   assembly.refusals.size() - 1);
    }
    return std::move(assembly.imported);
}

} // namespace weft
