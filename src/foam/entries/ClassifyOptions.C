// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/ClassifyOptions.H"

#include "foam/entries/EntryReaders.H"
#include "foam/errors/Failures.H"

namespace Foam::stability
{

namespace
{

// It belongs to some of the controls.
scalar readInterval(const dictionary& dict, ClassifyControl control)
{
    using Control = ClassifyControl;
    if (control == Control::timeStep || control == Control::writeTime)
    {
        return readNumber<label>(dict, "classifyInterval");
    }
    const bool isTime =
        control == Control::runTime || control == Control::adjustableRunTime;
    const bool found = dict.found("classifyInterval", keyType::LITERAL);
    if (isTime && !found)
    {
        failOn(
            dict, "Entry 'classifyInterval' is missing, which classifyControl "
                      + classifyControlNames()[control] + " needs."
        );
    }
    if (!isTime && found)
    {
        refuse(
            dict, "classifyInterval",
            "an interval with the classifyControl timeStep, writeTime, runTime or "
            "adjustableRunTime only"
        );
    }
    return isTime ? readNumber<scalar>(dict, "classifyInterval") : 1;
}

} // namespace

const Enum<ClassifyControl>& classifyControlNames()
{
    static const Enum<ClassifyControl> names({
        {ClassifyControl::asWritten, "asWritten"},
        {ClassifyControl::none, "none"},
        {ClassifyControl::timeStep, "timeStep"},
        {ClassifyControl::writeTime, "writeTime"},
        {ClassifyControl::runTime, "runTime"},
        {ClassifyControl::adjustableRunTime, "adjustableRunTime"},
        {ClassifyControl::onEnd, "onEnd"},
    });
    return names;
}

ClassifyOptions readClassify(const dictionary& dict)
{
    ClassifyOptions options;
    options.control = readEnum(dict, "classifyControl", classifyControlNames());
    options.interval = readInterval(dict, options.control);
    options.displacement = readNumber<scalar>(dict, "classifyDisplacement", 0);
    if (options.control == ClassifyControl::none && options.displacement == 0)
    {
        refuse(dict, "classifyControl", "none together with classifyDisplacement only");
    }
    return options;
}

} // namespace Foam::stability
