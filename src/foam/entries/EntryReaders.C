// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/EntryReaders.H"

#include "core/base/Errors.H"
#include "foam/errors/Failures.H"
#include "HashSet.H"
#include "StringStream.H"

#include <algorithm>
#include <cstdlib>

namespace Foam::stability
{

namespace
{

template<class Type>
constexpr EntryType numberType =
    std::is_same_v<Type, label> ? EntryType::wholeNumber : EntryType::number;

// The default of a row that has a number for it.
scalar standardNumber(const EntryRow& row)
{
    scalar value = 0;
    if (!readScalar(row.standard, value))
    {
        FatalErrorInFunction << "The default of '" << row.name << "' is no number."
                             << exit(FatalError);
    }
    return value;
}

word choose(
    const dictionary& dict, const EntryRow& row, const word& standard,
    const wordList& barred
)
{
    if (!dict.found(row.name, keyType::LITERAL))
    {
        return standard;
    }
    EntryValue allowed(row.value);
    std::vector<std::string>& names = allowed.choices;
    names.erase(
        std::remove_if(
            names.begin(), names.end(),
            [&](const std::string& name) { return barred.found(word(name)); }
        ),
        names.end()
    );
    const std::string value = given(dict, row.name);
    if (std::find(names.begin(), names.end(), value) == names.end())
    {
        refuse(dict, row.name, allowedText(allowed));
    }
    return value;
}

bool isName(const token& t)
{
    return t.isWord() && t.wordToken() != "." && t.wordToken() != "..";
}

// Index of the token after a block in braces that begins at `i`; the number of tokens
// where there is no such block.
label behindBlock(const UList<token>& tokens, label i)
{
    label depth = 0;
    for (; i < tokens.size(); ++i)
    {
        const token& t = tokens[i];
        depth += t.isPunctuation() && t.pToken() == token::BEGIN_BLOCK;
        depth -= t.isPunctuation() && t.pToken() == token::END_BLOCK;
        if (depth == 0)
        {
            return i + 1;
        }
    }
    return i;
}

// True for ( name {...} ... ). OpenFOAM's reader of such lists does not stand others.
bool isListOfDictionaries(const UList<token>& tokens)
{
    const label n = tokens.size();
    const auto isMark = [&](label i, token::punctuationToken mark)
    { return i < n && tokens[i].isPunctuation() && tokens[i].pToken() == mark; };
    if (n < 2 || !isMark(0, token::BEGIN_LIST) || !isMark(n - 1, token::END_LIST))
    {
        return false;
    }
    label i = 1;
    while (i < n - 1 && isName(tokens[i]) && isMark(i + 1, token::BEGIN_BLOCK))
    {
        i = behindBlock(tokens, i + 1);
    }
    return i == n - 1;
}

} // namespace

void checkKeys(const dictionary& dict, EntryPlace place, const wordList& others)
{
    const wordList allowed(entryNames(place));
    wordHashSet known(allowed);
    known.insert(others);
    for (const entry& e : dict)
    {
        if (e.keyword() != "FoamFile" && !known.found(e.keyword()))
        {
            failOn(
                dict, "Unknown entry '" + e.keyword() + "'; allowed are "
                          + listed(allowed) + "."
            );
        }
    }
}

std::string given(const dictionary& dict, const word& key)
{
    OStringStream os;
    const entry* e = dict.findEntry(key, keyType::LITERAL);
    if (e && e->isDict())
    {
        return "{...}";
    }
    if (e)
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
    failOn(
        dict,
        "Entry '" + key + "' is '" + given(dict, key) + "'; allowed is " + allowed + "."
    );
}

template<class Type>
Type readNumber(const dictionary& dict, const word& key, std::optional<Type> standard)
{
    const EntryRow& row = entryRow(key, numberType<Type>);
    const entry* e = dict.findEntry(key, keyType::LITERAL);
    if (!e)
    {
        return standard ? *standard : Type(standardNumber(row));
    }
    const EntryValue& allowed = row.value;
    const bool one = e->isStream() && e->stream().size() == 1;
    const token& t = one ? e->stream()[0] : token::undefinedToken;
    const bool whole = allowed.type == EntryType::wholeNumber;
    if (whole ? !t.isLabel() : !t.isNumber())
    {
        refuse(dict, key, allowedText(allowed));
    }
    const scalar value = t.number();
    if (value < allowed.low || value > allowed.high
        || (allowed.openLow && value == allowed.low))
    {
        refuse(dict, key, allowedText(allowed));
    }
    return Type(value);
}

template scalar readNumber(const dictionary&, const word&, std::optional<scalar>);
template label readNumber(const dictionary&, const word&, std::optional<label>);

word readChoice(
    const dictionary& dict, const word& key, std::optional<word> standard,
    const wordList& barred
)
{
    const EntryRow& row = entryRow(key, EntryType::choice);
    return choose(dict, row, standard ? *standard : word(row.standard), barred);
}

bool readSwitch(const dictionary& dict, const word& key, std::optional<bool> standard)
{
    const EntryRow& row = entryRow(key, EntryType::yesNo);
    const word usual(row.standard);
    const word value = choose(
        dict, row, standard ? word(*standard ? "yes" : "no") : usual, wordList()
    );
    return value == "yes" || value == "true" || value == "on";
}

word readName(const dictionary& dict, const word& key, std::optional<word> standard)
{
    const EntryRow& row = entryRow(key, EntryType::name);
    const std::string value = given(dict, key);
    if (dict.found(key, keyType::LITERAL)
        && (value.empty() || !word::valid(value.front())
            || value.find(' ') != value.npos))
    {
        refuse(dict, key, allowedText(row.value));
    }
    return !value.empty() ? word(value) : standard ? *standard : word(row.standard);
}

std::vector<NamedEntries> readList(const dictionary& dict, const word& key)
{
    const EntryRow& row = entryRow(key, EntryType::list);
    const entry* e = dict.findEntry(key, keyType::LITERAL);
    std::vector<NamedEntries> all;
    if (!e)
    {
        return all;
    }
    if (!e->isStream() || !isListOfDictionaries(e->stream()))
    {
        refuse(dict, key, allowedText(row.value));
    }
    for (const entry& one : PtrList<entry>(dict.lookup(key)))
    {
        all.push_back({one.keyword(), one.dict()});
    }
    return all;
}

} // namespace Foam::stability
