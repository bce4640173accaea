// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/FileReplacement.H"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

using namespace Foam::stability;
namespace fs = std::filesystem;

class FileReplacement : public ::testing::Test
{
protected:
    void SetUp() override
    {
        folder_ = fs::temp_directory_path() / fs::path(::testing::TempDir()).filename();
        folder_ /= "interfaceStability.FileReplacement";
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const
    {
        return (folder_ / name).string();
    }

    static std::string contentOf(const std::string& path)
    {
        std::ifstream file(path);
        return std::string(std::istreambuf_iterator<char>(file), {});
    }

    long nFiles() const
    {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

    fs::path folder_;
};

TEST_F(FileReplacement, replacesTheWholeFile)
{
    replaceFile(path("a"), "a longer text");
    replaceFile(path("a"), "short");
    EXPECT_EQ(contentOf(path("a")), "short");
    EXPECT_EQ(nFiles(), 1);
}

// A program that was killed leaves its temporary file: the next one takes its place.
TEST_F(FileReplacement, clearsWhatAKilledProgramLeft)
{
    std::ofstream(path("a.tmp")) << "half of a text that is lon";
    replaceFile(path("a"), "text");
    EXPECT_EQ(contentOf(path("a")), "text");
    EXPECT_EQ(nFiles(), 1);
}

TEST_F(FileReplacement, addsToTheEnd)
{
    appendToFile(path("a"), "one\n");
    appendToFile(path("a"), "two\n");
    EXPECT_EQ(contentOf(path("a")), "one\ntwo\n");
    EXPECT_THROW(appendToFile(path("nowhere/a"), "text"), std::runtime_error);
}

TEST_F(FileReplacement, failsAndLeavesNothing)
{
    fs::create_directory(folder_ / "taken");
    try
    {
        replaceFile(path("taken"), "text");
        FAIL() << "a folder was replaced";
    }
    catch (const std::runtime_error& failure)
    {
        EXPECT_NE(std::string(failure.what()).find(path("taken")), std::string::npos);
    }
    EXPECT_THROW(replaceFile(path("nowhere/a"), "text"), std::runtime_error);
    EXPECT_EQ(nFiles(), 1);
}
