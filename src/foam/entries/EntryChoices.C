// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/EntryChoices.H"

namespace Foam::stability
{

const Enum<Merge>& mergeNames()
{
    static const Enum<Merge> names({
        {Merge::nearest, "nearest"},
        {Merge::untracked, "untracked"},
    });
    return names;
}

const Enum<VelocityKind>& velocityNames()
{
    static const Enum<VelocityKind> names({
        {VelocityKind::U, "U"},
        {VelocityKind::flux, "flux"},
    });
    return names;
}

const Enum<WallVelocity>& wallVelocityNames()
{
    static const Enum<WallVelocity> names({
        {WallVelocity::slip, "slip"},
        {WallVelocity::noSlip, "noSlip"},
    });
    return names;
}

const Enum<OnError>& onErrorNames()
{
    static const Enum<OnError> names({
        {OnError::stop, "stop"},
        {OnError::resume, "resume"},
    });
    return names;
}

const Enum<SurfaceParts>& surfacePartsNames()
{
    static const Enum<SurfaceParts> names({
        {SurfaceParts::whole, "whole"},
        {SurfaceParts::pieces, "pieces"},
    });
    return names;
}

} // namespace Foam::stability
