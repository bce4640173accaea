// SPDX-License-Identifier: GPL-3.0-or-later

#include "Display.H"

#include <X11/Xlib.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Foam::stability
{

namespace
{

constexpr int patience = 60; // [s] until Xvfb must have started
constexpr int noProgram = 127;

[[noreturn]] void fail(const std::string& why)
{
    throw std::runtime_error(
        "There is no display, and Xvfb, which would make one, " + why
    );
}

bool displayAnswers()
{
    const char* name = std::getenv("DISPLAY");
    if (!name || !*name)
    {
        return false;
    }
    ::Display* display = XOpenDisplay(name); // VTK would abort the program
    if (display)
    {
        XCloseDisplay(display);
    }
    return display;
}

std::filesystem::path temporaryFolder()
{
    std::string name =
        std::filesystem::temp_directory_path() / "interfaceStabilityView.XXXXXX";
    if (!::mkdtemp(name.data()))
    {
        fail(std::string("has no folder for its key: ") + std::strerror(errno) + ".");
    }
    return name;
}

// An entry of an Xauthority file for whatever address: lengths are big-endian.
void writeKey(const std::filesystem::path& path)
{
    const std::string name = "MIT-MAGIC-COOKIE-1";
    std::string entry{'\xff', '\xff', 0, 0, 0, 0, 0, char(name.size())};
    entry += name + '\0' + char(16);
    std::random_device random;
    for (int i = 0; i < 16; ++i)
    {
        entry += char(random() & 0xff);
    }
    std::ofstream file(path, std::ios::binary);
    file.write(entry.data(), std::streamsize(entry.size()));
    if (!file.flush())
    {
        fail("cannot have its key written to " + path.string() + ".");
    }
}

// In the child: becomes Xvfb, which tells its number through the pipe and ends with us.
[[noreturn]] void becomeServer(int pipe, const std::string& key)
{
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nowhere = ::open("/dev/null", O_RDWR);
    ::dup2(nowhere, STDIN_FILENO);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    const std::string pipeText = std::to_string(pipe);
    ::execlp(
        "Xvfb", "Xvfb", "-displayfd", pipeText.c_str(), "-auth", key.c_str(), "-screen",
        "0", "1280x1024x24", "-nolisten", "tcp", "-noreset", nullptr
    );
    ::_exit(noProgram);
}

} // namespace

Display::Display()
{
    if (displayAnswers())
    {
        return;
    }
    try
    {
        start();
    }
    catch (...)
    {
        stop();
        throw;
    }
}

Display::~Display()
{
    stop();
}

void Display::start()
{
    folder_ = temporaryFolder();
    const std::string key = folder_ / "Xauthority";
    writeKey(key);

    int pipe[2];
    if (::pipe(pipe) != 0 || (server_ = ::fork()) < 0)
    {
        fail(std::string("cannot be started: ") + std::strerror(errno) + ".");
    }
    if (server_ == 0)
    {
        ::close(pipe[0]);
        becomeServer(pipe[1], key);
    }
    ::close(pipe[1]);
    const std::string number = waitForNumber(pipe[0]);
    ::close(pipe[0]);
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
    ::setenv("XAUTHORITY", key.c_str(), 1);
    if (!displayAnswers())
    {
        fail("does not answer as display :" + number + ".");
    }
}

std::string Display::waitForNumber(int pipe)
{
    std::string number;
    pollfd ready{pipe, POLLIN, 0};
    while (::poll(&ready, 1, 1000 * patience) > 0)
    {
        char c = 0;
        if (::read(pipe, &c, 1) != 1) // it is ending
        {
            int status = 0;
            ::waitpid(server_, &status, 0);
            server_ = -1;
            if (WIFEXITED(status) && WEXITSTATUS(status) == noProgram)
            {
                fail("is not there: install the package xvfb.");
            }
            break;
        }
        if (c == '\n')
        {
            return number;
        }
        number += c;
    }
    fail("does not start: run 'Xvfb :99' to see why.");
}

void Display::stop()
{
    if (server_ > 0)
    {
        ::kill(server_, SIGTERM);
        ::waitpid(server_, nullptr, 0);
        server_ = -1;
    }
    if (!folder_.empty())
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
}

} // namespace Foam::stability
