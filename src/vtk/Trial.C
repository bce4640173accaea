// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtk/Trial.H"

#include <cerrno>
#include <cstdint>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Foam::stability
{

namespace
{

// In the child: no output, no core file, and no handler of this program for its crash.
[[noreturn]] void becomeTrial(const std::function<bool()>& work, unsigned seconds)
{
    const int nowhere = ::open("/dev/null", O_RDWR);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::alarm(seconds);
    bool good = false;
    try
    {
        good = work();
    }
    catch (...)
    {
        good = false;
    }
    ::_exit(good ? 0 : 1);
}

} // namespace

bool succeedsInChild(const std::function<bool()>& work, unsigned seconds)
{
    const pid_t child = ::fork();
    if (child == 0)
    {
        becomeTrial(work, seconds);
    }
    int status = 0;
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR)
    {
    }
    return child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

unsigned secondsToRead(const std::filesystem::path& path)
{
    namespace fs = std::filesystem;
    constexpr std::uintmax_t least = 10;        // [s]
    constexpr std::uintmax_t slowest = 1000000; // [bytes/s]
    const auto sizeOf = [](const fs::path& file)
    {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(file, error);
        return error ? 0 : size;
    };
    std::uintmax_t size = sizeOf(path);
    std::error_code none;
    fs::path pieces = path;
    for (const auto& piece : fs::directory_iterator(pieces.replace_extension(), none))
    {
        size += sizeOf(piece.path());
    }
    return unsigned(least + size / slowest);
}

} // namespace Foam::stability
