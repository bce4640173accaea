// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/EntryHelp.H"

#include "core/base/Errors.H"
#include "foam/entries/EntryTable.H"

#include <algorithm>
#include <sstream>

namespace Foam::stability
{

namespace
{

constexpr std::size_t helpWidth = 78;
constexpr std::size_t helpColumn = 24; // where the help of an entry begins

// The words after `start`, in lines that begin at this column; `start` may reach into
// it.
std::string
wrapped(const std::string& start, std::size_t column, const std::string& words)
{
    std::string text;
    std::string line(start);
    line.resize(std::max(column, start.size()), ' ');
    bool empty = true;
    std::istringstream is(words);
    for (std::string next; is >> next; empty = false)
    {
        if (!empty && line.size() + 1 + next.size() > helpWidth)
        {
            text += line + '\n';
            line.assign(column, ' ');
            empty = true;
        }
        line += (empty ? "" : " ") + next;
    }
    return text + line + '\n';
}

std::string rowHelp(const EntryRow& row)
{
    const std::string standard =
        row.standard.empty() ? "no default" : "default " + row.standard;
    return wrapped("  " + row.name + ' ', helpColumn, row.help)
           + wrapped("", helpColumn, standard + "; " + allowedText(row.value));
}

// The entries whose places are these, below a title.
std::string section(const std::string& title, bool (*isIn)(unsigned places))
{
    std::string text('\n' + title + ":\n");
    for (const EntryRow& row : entryTable())
    {
        text += isIn(row.places) ? rowHelp(row) : "";
    }
    return text;
}

std::string within(const std::string& list, EntryPlace place)
{
    const wordList names(entryNames(place));
    return '\n' + wrapped("", 0, "Within " + list + ": " + listed(names) + '.');
}

} // namespace

std::vector<std::string> entryHelp()
{
    constexpr unsigned both = inUtility | inFunctionObject;
    return {
        section(
            "Entries of the dictionary, or of the function object",
            [](unsigned places) { return (places & both) == both; }
        ),
        section(
            "Entries of the utility only",
            [](unsigned places) { return (places & both) == inUtility; }
        ),
        section(
            "Entries of the function object only",
            [](unsigned places) { return (places & both) == inFunctionObject; }
        ),
        section(
            "Entries within reconstructions only",
            [](unsigned places) { return places == inReconstructions; }
        ),
        within("reconstructions", inReconstructions),
        within("methods", inMethods)};
}

} // namespace Foam::stability
