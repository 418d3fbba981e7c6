#include "base/error.h"
#include "scene/expectations.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

std::vector<Expectation> read(const std::string& text) {
    const test::TempFolder folder;
    return read_expectations(test::write_file(folder / "e.toml", text));
}

std::string message_of(const std::string& text) {
    try {
        read(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        const std::string what = error.what();
        return what.substr(what.find("e.toml"));
    }
    return "";
}

TEST(Expectations, ReadEveryKey) {
    const auto expectations = read("[[expect]]\nfile = 'images'\ncolumn = 'covered_share'\n"
                                   "min = 0.1\nmax = 0.5\nat = 'mean'\nframes = '10-50'\n"
                                   "[[expect]]\ncolumn = 'retries'\nequals = 3\nframes = '7'\n");

    ASSERT_EQ(expectations.size(), 2U);
    EXPECT_EQ(expectations[0].file, "images");
    EXPECT_EQ(expectations[0].column, "covered_share");
    EXPECT_EQ(expectations[0].min, 0.1);
    EXPECT_EQ(expectations[0].max, 0.5);
    EXPECT_EQ(expectations[0].at, ExpectAt::Mean);
    EXPECT_EQ(expectations[0].first_frame, 10);
    EXPECT_EQ(expectations[0].last_frame, 50);
    EXPECT_EQ(expectations[1].file, "stats");
    EXPECT_EQ(expectations[1].min, 3.0);
    EXPECT_EQ(expectations[1].max, 3.0);
    EXPECT_EQ(expectations[1].at, ExpectAt::Each);
    EXPECT_EQ(expectations[1].first_frame, 7);
    EXPECT_EQ(expectations[1].last_frame, 7);
}

TEST(Expectations, NameLineAndColumnOfWhatIsWrong) {
    EXPECT_EQ(message_of("[[expect]]\ncolumn = 'a'\nmax = 'b'\n").substr(0, 10), "e.toml:3:7");
    EXPECT_NE(message_of("[[expect]]\ncolumn = 'a'\nmaxx = 1\nmax = 2\n").find("max"),
              std::string::npos);
    EXPECT_NE(message_of("[[expect]]\ncolumn = 'a'\n").find("needs min, max or equals"),
              std::string::npos);
}

TEST(Expectations, RefuseWhatCannotBeMeant) {
    for (const char* keys :
         {"max = 1\nmin = 2", "equals = 1\nmax = 2", "max = 1\ntolerance = 0.1",
          "equals = 1\ntolerance = -1", "max = 1\nframes = '5-2'", "max = 1\nframes = '0-2'",
          "max = 1\nframes = 'x'", "max = 1\nframes = '1-2x'", "max = 1\nat = 'never'",
          "max = 1\nfile = 'log'"}) {
        EXPECT_NE(message_of(std::string("[[expect]]\ncolumn = 'a'\n") + keys + "\n"), "") << keys;
    }
    EXPECT_NE(message_of(""), "");
    EXPECT_NE(message_of("[[expect]]\nmax = 1\n"), "");
}

} // namespace
} // namespace weft
