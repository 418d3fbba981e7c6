#include "app/commands.h"
#include "scene/key.h"
#include "scene/key_pages.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace weft {
namespace {

struct KeysOptions {
    std::vector<std::string> words;
    bool markdown = false;
};

void print_keys(const KeysOptions& options) {
    const std::string list = options.markdown ? key_page() : key_list(options.words);
    if (list.empty()) {
        const std::string& word = options.words.front();
        throw Error(ExitCode::CommandLine,
                    fmt::format("keys {}: no key of a scene contains that; the nearest is {}", word,
                                nearest_key(word, key_paths())));
    }
    fmt::print("{}", list);
}

} // namespace

void add_keys_command(CLI::App& app, ExitCode&) {
    CLI::App* keys =
        app.add_subcommand("keys", "the keys of a scene file: default, range, meaning");
    const auto options = std::make_shared<KeysOptions>();
    keys->add_option("word", options->words, "only keys whose path contains it, as cloth.fabric")
        ->type_name("WORD");
    keys->add_flag("--markdown", options->markdown, "all of them as the page docs/scene-keys.md");
    keys->callback([options] { print_keys(*options); });
}

} // namespace weft
