#include "scene/scene_from_files.h"

#include "base/error.h"
#include "scene/names.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace weft {
namespace {

[[noreturn]] void refuse_pin(const std::string& spec) {
    throw Error(ExitCode::CommandLine,
                fmt::format("--pin {}: must be corners, top, bottom, loop:N, vertices:I,J,... or "
                            "box:x0,y0,z0,x1,y1,z1, then @OBSTACLE to follow one",
                            spec));
}

/// The numbers of `0,31`; refuses what is not a number.
std::vector<double> numbers_of(const std::string& list, const std::string& spec) {
    std::vector<double> numbers;
    std::istringstream stream(list);
    for (std::string item; std::getline(stream, item, ',');) {
        std::size_t used = 0;
        try {
            numbers.push_back(std::stod(item, &used));
        } catch (const std::exception&) {
            refuse_pin(spec);
        }
        if (used != item.size() || !std::isfinite(numbers.back())) {
            refuse_pin(spec);
        }
    }
    if (numbers.empty() || list.ends_with(',')) {
        refuse_pin(spec);
    }
    return numbers;
}

std::vector<int> indices_of(const std::string& list, const std::string& spec) {
    std::vector<int> indices;
    for (const double number : numbers_of(list, spec)) {
        if (number < 0.0 || number > 2e9 || number != std::floor(number)) {
            refuse_pin(spec);
        }
        indices.push_back(static_cast<int>(number));
    }
    return indices;
}

void write_box(TomlWriter& out, const std::string& list, const std::string& spec) {
    const std::vector<double> b = numbers_of(list, spec);
    if (b.size() != 6) {
        refuse_pin(spec);
    }
    out.write("box",
              fmt::format("{{ min = {}, max = {} }}", TomlWriter::toml_text(Vec3(b[0], b[1], b[2])),
                          TomlWriter::toml_text(Vec3(b[3], b[4], b[5]))));
}

/// A name from the file's stem that none of `taken` has.
std::string unique_name(const std::filesystem::path& file, std::vector<std::string>& taken) {
    const std::string stem = object_name_from(file.stem().string());
    std::string name = stem;
    for (int i = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++i) {
        name = fmt::format("{}_{}", stem.substr(0, 58), i);
    }
    taken.push_back(name);
    return name;
}

/// A number as a number, a word as a word.
std::string units_text(const std::string& units) {
    double number = 0.0;
    const char* const last = units.data() + units.size();
    const auto [end, error] = std::from_chars(units.data(), last, number);
    const bool is_number = error == std::errc{} && end == last && std::isfinite(number);
    return is_number ? TomlWriter::toml_text(number) : TomlWriter::toml_text(units);
}

void write_file(TomlWriter& out,
                const SceneFiles& files,
                const std::filesystem::path& file,
                std::vector<std::string>& taken) {
    out.line("name", unique_name(file, taken));
    out.line("mesh", file.string());
    if (!files.units.empty()) {
        out.write("units", units_text(files.units));
    }
    if (!files.up.empty()) {
        out.line("up", files.up);
    }
}

} // namespace

std::string write_pin_spec(const std::string& spec) {
    const std::size_t at = spec.find('@');
    const std::string selection = spec.substr(0, at);
    const std::size_t colon = selection.find(':');
    const std::string kind = selection.substr(0, colon);
    const std::string list = colon == std::string::npos ? "" : selection.substr(colon + 1);
    TomlWriter out;
    if (selection == "corners") {
        out.line("corners", true);
    } else if (selection == "top" || selection == "bottom") {
        out.line("loop", selection);
    } else if (kind == "loop") {
        const std::vector<int> loops = indices_of(list, spec);
        if (loops.size() != 1) {
            refuse_pin(spec);
        }
        out.line("loop", loops.front());
    } else if (kind == "vertices") {
        out.line("vertices", indices_of(list, spec));
    } else if (kind == "box") {
        write_box(out, list, spec);
    } else {
        refuse_pin(spec);
    }
    if (at != std::string::npos) {
        out.line("to", spec.substr(at + 1));
    }
    return out.text();
}

Scene scene_from_files(const SceneFiles& files, std::span<const std::string> sets) {
    std::vector<std::string> taken;
    TomlWriter out;
    out.header("[[cloth]]");
    write_file(out, files, files.garment, taken);
    out.line("fabric", files.fabric);
    std::string text = out.text();
    for (const std::string& pin : files.pins) {
        text += "[[cloth.pin]]\n" + write_pin_spec(pin);
    }
    for (const std::filesystem::path& file : files.obstacles) {
        TomlWriter obstacle;
        obstacle.header("[[obstacle]]");
        write_file(obstacle, files, file, taken);
        text += obstacle.text();
    }
    return read_scene_text(text, k_command_line_place, "", sets);
}

} // namespace weft
