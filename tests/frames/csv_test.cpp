#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/csv.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace weft {
namespace {

TEST(CsvNumber, ReadsBackToTheSameBits) {
    for (const double value : {0.1, 1.0 / 3.0, 5e-324, -1.7976931348623157e308, 123456789.0}) {
        EXPECT_EQ(std::strtod(csv_number(value).c_str(), nullptr), value);
    }
    EXPECT_EQ(csv_number(0.1), "0.1");
    EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "inf");
}

TEST(CsvTable, FindsColumnsAndNumbers) {
    const CsvTable table = parse_csv("frame,gap_m,hash\n1,0.5,ab\n2,inf,cd\n", "a.csv");

    ASSERT_EQ(table.rows.size(), 2U);
    EXPECT_EQ(table.find_column("gap_m"), 1);
    EXPECT_EQ(table.find_column("gap"), -1);
    EXPECT_EQ(table.number(0, 1), 0.5);
    EXPECT_TRUE(std::isinf(table.number(1, 1)));
    EXPECT_TRUE(std::isnan(table.number(0, 2)));
}

TEST(CsvTable, NamesTheLineThatIsTooShort) {
    try {
        parse_csv("a,b\n1,2\n3\n", "a.csv");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "a.csv:3: 1 cells: must be 2 as in the header");
    }
}

TEST(CsvTable, RefusesACutOffLine) {
    EXPECT_THROW(parse_csv("a,b\n1,2", "a.csv"), Error);
    EXPECT_THROW(parse_csv("", "a.csv"), Error);
}

TEST(CsvFile, KeepsRowsUnderTheHeaderOfTheVersionBefore) {
    const test::TempFolder folder;
    CsvFile old(folder / "a.csv", "frame,old_name");
    old.add("1,a");
    old.write();

    CsvFile file(folder / "a.csv", "frame,name", "frame,old_name");

    EXPECT_EQ(file.keep_rows_through(3), 1);
    EXPECT_EQ(file.text(), "frame,name\n1,a\n");
    EXPECT_THROW(CsvFile(folder / "a.csv", "frame,name", "frame,other").keep_rows_through(3),
                 Error);
}

TEST(CsvFile, KeepsTheRowsUpToAFrame) {
    const test::TempFolder folder;
    CsvFile file(folder / "a.csv", "frame,x");
    for (const char* row : {"1,a", "2,b", "3,c", "10,d"}) {
        file.add(row);
    }
    file.write();

    CsvFile again(folder / "a.csv", "frame,x");

    EXPECT_EQ(again.keep_rows_through(3), 3);
    EXPECT_EQ(again.text(), "frame,x\n1,a\n2,b\n3,c\n");
}

TEST(CsvFile, RefusesToGoOnWithOtherColumns) {
    const test::TempFolder folder;
    write_atomically(folder / "a.csv", std::string_view("frame,y\n1,a\n"));
    CsvFile file(folder / "a.csv", "frame,x");

    EXPECT_THROW(file.keep_rows_through(1), Error);
}

TEST(CsvFile, StopsReplacingALongTableAtEachRow) {
    const test::TempFolder folder;
    CsvFile file(folder / "a.csv", "frame,x");
    file.add("1," + std::string(2U << 20, 'x'));

    file.write_if_small();
    EXPECT_FALSE(std::filesystem::exists(folder / "a.csv"));
    file.write();
    EXPECT_EQ(read_file(folder / "a.csv"), file.text());
}

} // namespace
} // namespace weft
