// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/FileOperations.H"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace Foam::stability;
namespace fs = std::filesystem;

class FileOperations : public ::testing::Test
{
protected:
    void SetUp() override
    {
        folder_ = fs::path(::testing::TempDir()) / "interfaceStability.FileOperations";
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const
    {
        return (folder_ / name).string();
    }

    void write(const std::string& name) const { std::ofstream(path(name)) << "text"; }

    // The message of a failure, which must name the file.
    template<class Work>
    static std::string failureOf(const Work& work, const std::string& file)
    {
        try
        {
            work();
        }
        catch (const std::runtime_error& failure)
        {
            const std::string text = failure.what();
            EXPECT_NE(text.find(file + ": "), std::string::npos) << text;
            return text;
        }
        ADD_FAILURE() << "nothing failed at " << file;
        return "";
    }

    fs::path folder_;
};

TEST_F(FileOperations, foldersAreMadeOnceAndBehindLinks)
{
    makeFolders(path("a/b/c"));
    makeFolders(path("a/b/c"));
    EXPECT_TRUE(isFolder(path("a/b/c")));
    fs::create_directory_symlink("a", folder_ / "link");
    makeFolders(path("link/d/"));
    EXPECT_TRUE(isFolder(path("a/d")));
    EXPECT_EQ(inTheWayOf(path("link/d/e")), "");
}

TEST_F(FileOperations, linksToNowhereAndFilesAreNoFolders)
{
    fs::create_directory_symlink("/nowhere/at/all", folder_ / "link");
    EXPECT_TRUE(isThere(path("link")));
    EXPECT_FALSE(isFolder(path("link")));
    EXPECT_EQ(
        inTheWayOf(path("link/a/b")),
        path("link") + " is a link to /nowhere/at/all, where no folder is, but "
            + path("link/a/b") + " is to be a folder."
    );
    failureOf([&] { makeFolders(path("link/a/b")); }, path("link"));

    write("file");
    EXPECT_EQ(
        inTheWayOf(path("file")),
        path("file") + " is a file, but " + path("file") + " is to be a folder."
    );
    failureOf([&] { makeFolders(path("file/a")); }, path("file"));
}

TEST_F(FileOperations, aSecondNameIsTheSameFile)
{
    write("a");
    write("b");
    EXPECT_TRUE(linkFile(path("a"), path("second")));
    EXPECT_FALSE(linkFile(path("a"), path("b")));
    EXPECT_TRUE(isSameFile(path("a"), path("second")));
    EXPECT_FALSE(isSameFile(path("a"), path("b")));
    EXPECT_FALSE(isSameFile(path("a"), path("none")));
}

TEST_F(FileOperations, whatIsGoneOrNotEmptyIsLeft)
{
    makeFolders(path("full/a"));
    removeEmptyFolder(path("full"));
    EXPECT_TRUE(isFolder(path("full")));
    removeEmptyFolder(path("full/a"));
    removeEmptyFolder(path("full/a"));
    EXPECT_FALSE(isThere(path("full/a")));
    write("a");
    removeFile(path("a"));
    removeFile(path("a"));
    EXPECT_FALSE(isThere(path("a")));
    failureOf([&] { removeFile(path("full")); }, path("full"));
    failureOf([&] { moveFile(path("a"), path("c")); }, path("a") + " to " + path("c"));
}
