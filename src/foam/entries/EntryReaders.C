// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/entries/EntryReaders.H"

#include "HashSet.H"
#include "StringStream.H"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace Foam::stability
{

void checkKeys(const dictionary& dict, const wordList& allowed, const wordList& others)
{
    wordHashSet known(allowed);
    known.insert(others);
    std::string list;
    for (const word& name : allowed)
    {
        list += (list.empty() ? "" : ", ") + name;
    }
    for (const entry& e : dict)
    {
        if (e.keyword() != "FoamFile" && !known.found(e.keyword()))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown entry '" << e.keyword() << "'; allowed are " << list.c_str()
                << '.' << exit(FatalIOError);
        }
    }
}

std::string given(const dictionary& dict, const word& key)
{
    OStringStream os;
    const entry* e = dict.findEntry(key, keyType::LITERAL);
    if (e && e->isStream())
    {
        for (const token& t : e->stream())
        {
            os << (os.str().empty() ? "" : " ") << t;
        }
    }
    return os.str();
}

[[noreturn]] void
refuse(const dictionary& dict, const word& key, const std::string& allowed)
{
    FatalIOErrorInFunction(dict)
        << "Entry '" << key << "' is '" << given(dict, key).c_str() << "'; allowed is "
        << allowed.c_str() << '.' << exit(FatalIOError);
    std::abort(); // not reached: exit() ends the program or throws
}

template<class Type>
Type readNumber(
    const dictionary& dict, const word& key, Type standard, const Range& range
)
{
    if (!dict.found(key, keyType::LITERAL))
    {
        return standard;
    }
    constexpr bool whole = std::is_same_v<Type, label>;
    std::ostringstream allowed;
    allowed << (whole ? "a whole number, " : "a number, ")
            << (range.openLow ? "above " : "") << range.low << " to " << range.high
            << range.unit;

    const entry* e = dict.findEntry(key, keyType::LITERAL);
    if (!e->isStream() || e->stream().size() != 1)
    {
        refuse(dict, key, allowed.str());
    }
    const token& t = e->stream()[0];
    if (whole ? !t.isLabel() : !t.isNumber())
    {
        refuse(dict, key, allowed.str());
    }
    const scalar value = t.number();
    if (value < range.low || value > range.high
        || (range.openLow && value == range.low))
    {
        refuse(dict, key, allowed.str());
    }
    return Type(value);
}

template scalar readNumber(const dictionary&, const word&, scalar, const Range&);
template label readNumber(const dictionary&, const word&, label, const Range&);

word readWord(
    const dictionary& dict, const word& key, const word& standard,
    const std::vector<std::string>& names
)
{
    if (!dict.found(key, keyType::LITERAL))
    {
        return standard;
    }
    const std::string value = given(dict, key);
    if (std::find(names.begin(), names.end(), value) == names.end())
    {
        std::string list;
        for (const std::string& name : names)
        {
            list += (list.empty() ? "" : ", ") + name;
        }
        refuse(dict, key, "one of " + list);
    }
    return value;
}

bool readSwitch(const dictionary& dict, const word& key, bool standard)
{
    const std::vector<std::string> names{"yes", "no", "true", "false", "on", "off"};
    const word value = readWord(dict, key, standard ? "yes" : "no", names);
    return value == "yes" || value == "true" || value == "on";
}

word readName(const dictionary& dict, const word& key, const word& standard)
{
    const std::string value = given(dict, key);
    if (dict.found(key, keyType::LITERAL)
        && (value.empty() || !word::valid(value.front())
            || value.find(' ') != value.npos))
    {
        refuse(dict, key, "one name");
    }
    return value.empty() ? standard : word(value);
}

} // namespace Foam::stability
