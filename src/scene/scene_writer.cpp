#include "scene/scene_writer.h"

#include "scene/scene_keys.h"
#include "scene/toml_keys.h"

#include <fmt/core.h>

namespace weft {

namespace {

/// Writes the tables of a scene one after the other. It binds keys to the values that it writes, so
/// it has a scene of its own.
class SceneWriter {
public:
    SceneWriter(const Scene& scene, const std::filesystem::path& folder)
        : scene_(scene), path_text_([base = scene.base_dir, folder](const std::string& file) {
              return std::filesystem::proximate(base / file, folder).generic_string();
          }) {}

    std::string write() {
        table("[scene]", keys_of(scene_.scene));
        table("[contact]", keys_of(scene_.contact));
        tables("[[contact.friction]]", scene_.contact.friction);
        for (ClothParams& cloth : scene_.cloths) {
            write_cloth(cloth);
        }
        for (SolidParams& solid : scene_.solids) {
            table("[[solid]]", keys_of(solid));
            table("[solid.spring]", keys_of(solid.spring, solid.model, SpringOwner::Solid));
            tables("[[solid.pin]]", solid.pins);
        }
        tables("[[rigid]]", scene_.rigids);
        tables("[[obstacle]]", scene_.obstacles);
        tables("[[attach]]", scene_.attachments);
        table("[render]", keys_of(scene_.render));
        return out_.text();
    }

private:
    void table(const char* header, const Keys& keys) {
        out_.header(header);
        write_keys(out_, keys, path_text_);
    }

    template <typename Params> void tables(const char* header, std::vector<Params>& all) {
        for (Params& params : all) {
            table(header, keys_of(params));
        }
    }

    void write_cloth(ClothParams& cloth) {
        table("[[cloth]]", keys_of(cloth));
        table("[cloth.fabric]", keys_of(cloth.fabric));
        if (cloth.model == Model::Corotational) {
            table("[cloth.adapt]", keys_of(cloth.adapt));
        } else {
            table("[cloth.spring]", keys_of(cloth.spring, cloth.model, SpringOwner::Cloth));
        }
        tables("[[cloth.pin]]", cloth.pins);
    }

    Scene scene_;
    PathText path_text_; ///< from the folder, through links resolved on both sides
    TomlWriter out_;
};

} // namespace

std::string write_scene(const Scene& scene, const std::filesystem::path& folder) {
    return SceneWriter(scene, folder).write();
}

void TomlWriter::header(std::string_view bracketed) {
    text_ += fmt::format("{}{}\n", text_.empty() ? "" : "\n", bracketed);
}

void TomlWriter::write(std::string_view key, std::string_view value, std::string_view comment) {
    text_ += fmt::format("{} = {}", key, value);
    if (!comment.empty()) {
        text_ += fmt::format("  # {}", comment);
    }
    text_ += '\n';
}

std::string TomlWriter::toml_text(bool value) {
    return value ? "true" : "false";
}

std::string TomlWriter::toml_text(int value) {
    return fmt::format("{}", value);
}

std::string TomlWriter::toml_text(double value) {
    const std::string text = fmt::format("{}", value);
    const bool reads_as_integer = text.find_first_not_of("-0123456789") == std::string::npos;
    return reads_as_integer ? text + ".0" : text;
}

std::string TomlWriter::toml_text(const std::string& value) {
    std::string text = "\"";
    for (const char c : value) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            text += '\\';
            text += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            text += fmt::format("\\u{:04x}", byte);
        } else {
            text += c;
        }
    }
    return text + '"';
}

} // namespace weft
