// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "Display.H"

#include <X11/Xlib.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

namespace Foam::stability
{

namespace
{

// Set for the second run, so that a broken xvfb-run cannot make an endless chain.
constexpr const char* secondRun = "INTERFACE_STABILITY_VIEW_XVFB";

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

} // namespace

void ensureDisplay(int argc, char* argv[])
{
    if (displayAnswers())
    {
        return;
    }
    if (std::getenv(secondRun))
    {
        throw std::runtime_error(
            "The X server that xvfb-run started does not answer: run "
            "'xvfb-run -a true' to see why."
        );
    }
    ::setenv(secondRun, "1", 1);
    ::unsetenv("DISPLAY");

    std::vector<char> self(4096, '\0');
    if (::readlink("/proc/self/exe", self.data(), self.size() - 1) < 0)
    {
        throw std::runtime_error("Cannot find the own program under /proc/self/exe.");
    }
    std::vector<std::string> words{
        "xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -nolisten tcp", self.data()};
    words.insert(words.end(), argv + 1, argv + argc);
    std::vector<char*> pointers;
    for (std::string& word : words)
    {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    ::execvp(pointers[0], pointers.data());
    throw std::runtime_error(
        std::string("There is no display, and xvfb-run, which would make one, cannot "
                    "be run (")
        + std::strerror(errno) + "): install the package xvfb."
    );
}

} // namespace Foam::stability
