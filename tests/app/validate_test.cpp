#include "app/commands.h"
#include "base/atomic_file.h"
#include "frames/csv.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

int run(std::vector<const char*> words) {
    words.insert(words.begin(), "weft");
    return run_command_line(static_cast<int>(words.size()), words.data());
}

} // namespace

TEST(ValidateCommand, WritesBothTables) {
    const test::TempFolder folder;
    const std::string out = (folder / "table").string();

    EXPECT_EQ(run({"validate", "-o", out.c_str(), "--only", "uniaxial"}), 0);

    const CsvTable table = parse_csv(read_file(folder / "table" / "validation.csv"), "table");
    EXPECT_EQ(table.rows.size(), 6U); // modulus and Poisson ratio on three meshes
    EXPECT_NE(read_file(folder / "table" / "validation.md").find("## uniaxial"), std::string::npos);
}

TEST(ValidateCommand, RefusesWhatItCannotRun) {
    const test::TempFolder folder;
    const std::string out = folder.path().string();

    EXPECT_EQ(run({"validate", "-o", out.c_str(), "--only", "no such thing"}), 2);
    EXPECT_EQ(run({"validate", "--only", "uniaxial"}), 2); // no folder
    write_atomically(folder / "mine.txt", std::string_view("mine"));
    EXPECT_EQ(run({"validate", "-o", out.c_str(), "--only", "uniaxial"}), 2);
    EXPECT_EQ(run({"validate", "-o", out.c_str(), "--only", "uniaxial", "--overwrite"}), 0);
    EXPECT_EQ(read_file(folder / "mine.txt"), "mine");
}

} // namespace weft
