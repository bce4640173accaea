// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/FileOperations.H"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include <sys/stat.h>
#include <unistd.h>

namespace Foam::stability
{

namespace
{

[[noreturn]] void failTo(const std::string& what, const std::string& path, int reason)
{
    throw std::runtime_error(
        "Cannot " + what + ' ' + path + ": " + std::strerror(reason) + "."
    );
}

// The target of a link; empty if the path is none.
std::string targetOf(const std::string& path)
{
    char target[4096];
    const ssize_t size = ::readlink(path.c_str(), target, sizeof target);
    return size < 0 ? std::string() : std::string(target, std::size_t(size));
}

// The folders of a path, from the outermost to itself: a, a/b, a/b/c.
template<class Work>
void forFoldersOf(const std::string& path, const Work& work)
{
    for (std::size_t end = 0; end < path.size();)
    {
        end = std::min(path.find('/', end + 1), path.size());
        work(path.substr(0, end));
    }
}

} // namespace

bool isThere(const std::string& path)
{
    struct stat it;
    return ::lstat(path.c_str(), &it) == 0;
}

bool isFolder(const std::string& path)
{
    struct stat it;
    return ::stat(path.c_str(), &it) == 0 && S_ISDIR(it.st_mode);
}

bool isSameFile(const std::string& a, const std::string& b)
{
    struct stat one, other;
    return ::lstat(a.c_str(), &one) == 0 && ::lstat(b.c_str(), &other) == 0
           && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

std::string inTheWayOf(const std::string& folder)
{
    std::string sentence;
    forFoldersOf(
        folder,
        [&](const std::string& part)
        {
            if (sentence.empty() && isThere(part) && !isFolder(part))
            {
                const std::string target = targetOf(part);
                sentence = part
                           + (target.empty()
                                  ? " is a file"
                                  : " is a link to " + target + ", where no folder is")
                           + ", but " + folder + " is to be a folder.";
            }
        }
    );
    return sentence;
}

void makeFolders(const std::string& path)
{
    forFoldersOf(
        path,
        [&](const std::string& part)
        {
            if (isFolder(part) || ::mkdir(part.c_str(), 0777) == 0)
            {
                return;
            }
            const int reason = errno;
            if (!isFolder(part)) // another rank or program may have made it just now
            {
                failTo("make the folder", part, reason);
            }
        }
    );
}

void moveFile(const std::string& from, const std::string& to)
{
    if (std::rename(from.c_str(), to.c_str()) != 0)
    {
        failTo("move the file", from + " to " + to, errno);
    }
}

bool linkFile(const std::string& file, const std::string& name) noexcept
{
    return ::link(file.c_str(), name.c_str()) == 0;
}

void removeFile(const std::string& path)
{
    if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    {
        failTo("remove the file", path, errno);
    }
}

void removeEmptyFolder(const std::string& path)
{
    if (::rmdir(path.c_str()) != 0 && errno != ENOENT && errno != ENOTEMPTY
        && errno != EEXIST)
    {
        failTo("remove the folder", path, errno);
    }
}

} // namespace Foam::stability
