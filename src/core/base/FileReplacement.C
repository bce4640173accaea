// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/FileReplacement.H"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include <sys/stat.h>

namespace Foam::stability
{

namespace
{

// The reason must be taken before anything else touches errno.
[[noreturn]] void fail(const std::string& path, int reason)
{
    throw std::runtime_error(
        "Cannot write the file " + path + ": " + std::strerror(reason) + "."
    );
}

// Zero, or the reason why the bytes are not all in the file.
int writeAll(std::FILE* file, const void* bytes, std::size_t size)
{
    const bool written = std::fwrite(bytes, 1, size, file) == size;
    const int writeReason = written ? 0 : errno;
    const bool closed = std::fclose(file) == 0; // a full disk may show only here
    return writeReason ? writeReason : closed ? 0 : errno;
}

} // namespace

void replaceFile(const std::string& path, const void* bytes, std::size_t size)
{
    // Renaming over a folder fails late and with an unclear reason.
    struct stat there;
    if (::stat(path.c_str(), &there) == 0 && S_ISDIR(there.st_mode))
    {
        fail(path, EISDIR);
    }

    const std::string temporary = path + temporaryEnding;
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file)
    {
        fail(path, errno);
    }
    int reason = writeAll(file, bytes, size);
    if (!reason && std::rename(temporary.c_str(), path.c_str()) != 0)
    {
        reason = errno;
    }
    if (reason)
    {
        std::remove(temporary.c_str());
        fail(path, reason);
    }
}

void replaceFile(const std::string& path, const std::string& text)
{
    replaceFile(path, text.data(), text.size());
}

void appendToFile(const std::string& path, const std::string& text)
{
    std::FILE* file = std::fopen(path.c_str(), "ab");
    const int reason = file ? writeAll(file, text.data(), text.size()) : errno;
    if (reason)
    {
        fail(path, reason);
    }
}

} // namespace Foam::stability
