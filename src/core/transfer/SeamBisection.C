// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/SeamBisection.H"

namespace Foam::stability
{

// The part of the edge from a to b between the points w1 and w2 of Algorithm 1.
struct SeamBisection::Piece
{
    const SheetPoint &a, &b; // ends of the edge
    scalar length;           // of the edge [m]
    scalar at1, at2;         // in [0, 1] along the edge
    const SheetPoint &w1, &w2;
};

SeamBisection::SeamBisection(
    const MatchTarget& target, const ParameterSheets& sheets,
    const TransferOptions& options
)
    : target_(target), sheets_(sheets), options_(options)
{
}

SheetParameter SeamBisection::parameter(const Match& match) const
{
    const bool tracked =
        match.stable && (options_.merge == Merge::nearest || match.nPreimages <= 1);
    return tracked ? sheets_.at(match.nearest) : SheetParameter();
}

SheetPoint
SeamBisection::locate(const point& x, const vector& normal, scalar cellSize) const
{
    SheetPoint v{x, normal, cellSize, target_.nearest({x, normal, cellSize}), {}};
    if (options_.merge == Merge::untracked)
    {
        countPreimages(v);
    }
    v.sheet = parameter(v.match);
    return v;
}

void SeamBisection::countPreimages(SheetPoint& v) const
{
    target_.countPreimages(v.match, {v.x, v.normal, v.cellSize});
}

SheetPoint
SeamBisection::between(const SheetPoint& a, const SheetPoint& b, scalar share) const
{
    const vector n = (1 - share) * a.normal + share * b.normal;
    const scalar length = mag(n);
    return locate(
        (1 - share) * a.x + share * b.x, length > VSMALL ? n / length : vector(Zero),
        (1 - share) * a.cellSize + share * b.cellSize
    );
}

scalar SeamBisection::smallestJump(scalar length) const
{
    // Algorithm 1 resolves delta of an edge, and p changes by as much there. What is
    // hardly more is the end of a slit, where p closes.
    constexpr scalar share = 1e-3;
    return share * sheets_.scale() * length;
}

bool SeamBisection::joined(const SheetPoint& a, const SheetPoint& b, scalar slack) const
{
    const point &x = a.match.nearest.position, &y = b.match.nearest.position;
    return a.sheet.anchor == b.sheet.anchor
           || sheets_.connected(
               a.sheet.anchor, b.sheet.anchor, 0.5 * (x + y), mag(x - y) + slack
           );
}

// True if the piece is within one triangle of T, or no seam is anywhere near it.
bool SeamBisection::evidentlyJoined(const Piece& piece) const
{
    if (piece.w1.sheet.anchor == piece.w2.sheet.anchor)
    {
        return true;
    }
    const point& x = piece.w1.match.nearest.position;
    const point& y = piece.w2.match.nearest.position;
    const scalar slack = 1e-9 * piece.length;
    return !sheets_.seamWithin(0.5 * (x + y), mag(x - y) + slack)
           && joined(piece.w1, piece.w2, slack);
}

// On a seam both sides are equally near, and round-off chooses between them. A point
// takes the side of its neighbours then: an edge of M along a seam of T is not cut
// to pieces.
void SeamBisection::preferSide(SheetPoint& v, const Piece& piece) const
{
    const scalar tie = 1e-10 * piece.length;
    static thread_local DynamicList<label> ties;
    target_.admittedWithin(
        {v.x, v.normal, v.cellSize}, v.match.nearest.distance + tie, ties
    );
    if (ties.size() < 2)
    {
        return;
    }
    for (const SheetPoint* w : {&piece.w1, &piece.w2})
    {
        if (joined(*w, v, tie))
        {
            return;
        }
        for (const label trianglei : ties)
        {
            SheetPoint other(v);
            other.match.nearest = target_.locator().closestOn(trianglei, v.x);
            other.sheet = sheets_.at(other.match.nearest);
            if (other.sheet.valid() && joined(*w, other, tie))
            {
                v = other;
                return;
            }
        }
    }
}

// The first seam of the piece from its start, or from its end.
bool SeamBisection::firstCut(const Piece& piece, bool fromStart, SeamEvent& cut) const
{
    if (evidentlyJoined(piece))
    {
        return false;
    }
    const scalar at = 0.5 * (piece.at1 + piece.at2);
    cut = {at, false, piece.w1, piece.w2};
    const bool resolved = piece.at2 - piece.at1 <= options_.delta;
    SheetPoint v = resolved ? piece.w1 : between(piece.a, piece.b, at);
    if (resolved || !v.sheet.valid()) // or a hole in p narrower than the piece
    {
        return isCut(piece);
    }
    preferSide(v, piece);
    const Piece first{piece.a, piece.b, piece.length, piece.at1, at, piece.w1, v};
    const Piece second{piece.a, piece.b, piece.length, at, piece.at2, v, piece.w2};
    return firstCut(fromStart ? first : second, fromStart, cut)
           || firstCut(fromStart ? second : first, fromStart, cut);
}

// The test at the end of Algorithm 1: true if p jumps between w1 and w2.
bool SeamBisection::isCut(const Piece& piece) const
{
    const vector2D jump = piece.w2.sheet.p - piece.w1.sheet.p;
    const scalar distance =
        mag(piece.w1.match.nearest.position - piece.w2.match.nearest.position);
    return mag(jump) > smallestJump(piece.length)
           && !joined(piece.w1, piece.w2, distance);
}

// A piece so short that one cut is enough: a sheet that begins and ends within it is
// left out. Without such a limit the crumbs of p in a splash multiply from transfer
// to transfer.
void SeamBisection::bisectOnce(const Piece& piece, std::vector<SeamEvent>& events) const
{
    SeamEvent first, last;
    if (!firstCut(piece, true, first) || !firstCut(piece, false, last))
    {
        return;
    }
    const scalar distance =
        mag(first.before.match.nearest.position - last.after.match.nearest.position);
    if (first.at == last.at || !joined(first.before, last.after, distance))
    {
        first.after = last.after;
        events.push_back(first);
    }
}

// Algorithm 1. Both tests are evaluated, and both halves gone into where both are
// invalid: an else-if chain would miss every second seam.
void SeamBisection::bisect(const Piece& piece, std::vector<SeamEvent>& events) const
{
    if (evidentlyJoined(piece))
    {
        return;
    }
    if ((piece.at2 - piece.at1) * piece.length
        <= options_.narrowestSheet * piece.a.cellSize)
    {
        bisectOnce(piece, events);
        return;
    }

    const scalar at = 0.5 * (piece.at1 + piece.at2);
    SheetPoint v = between(piece.a, piece.b, at);
    if (!v.sheet.valid())
    {
        // A hole in p that one can walk around is no border between sheets.
        if (!joined(piece.w1, piece.w2, v.cellSize))
        {
            events.push_back({at, true, v, v});
        }
        return;
    }
    preferSide(v, piece);
    bisect({piece.a, piece.b, piece.length, piece.at1, at, piece.w1, v}, events);
    bisect({piece.a, piece.b, piece.length, at, piece.at2, v, piece.w2}, events);
}

// A sheet between two seams narrower than this share of the edge is left out.
void SeamBisection::mergeNear(std::vector<SeamEvent>& events, scalar narrowest) const
{
    std::vector<SeamEvent> kept;
    for (SeamEvent& event : events)
    {
        if (!kept.empty() && !event.gap && !kept.back().gap
            && event.at - kept.back().at < narrowest)
        {
            SeamEvent& merged = kept.back();
            merged.after = event.after;
            const scalar distance =
                mag(merged.before.match.nearest.position
                    - merged.after.match.nearest.position);
            if (joined(merged.before, merged.after, distance))
            {
                kept.pop_back(); // over to the narrow sheet and back
            }
        }
        else
        {
            kept.push_back(std::move(event));
        }
    }
    events = std::move(kept);
}

std::vector<SeamEvent>
SeamBisection::cuts(const SheetPoint& a, const SheetPoint& b) const
{
    std::vector<SeamEvent> events;
    if (a.sheet.valid() && b.sheet.valid())
    {
        const scalar length = mag(b.x - a.x);
        bisect({a, b, length, 0, 1, a, b}, events);
        mergeNear(events, options_.narrowestSheet * a.cellSize / (length + VSMALL));
    }
    return events;
}

SurfacePoint SeamBisection::footOnSide(const point& x, const SheetPoint& side) const
{
    if (side.match.nearest.triangle != side.sheet.anchor)
    {
        return SurfacePoint(); // extrapolated where T has corners without p
    }
    constexpr scalar roundOff = 1 + 1e-12;
    return sheets_.closestConnected(
        side.sheet.anchor, x, roundOff * mag(x - side.match.nearest.position)
    );
}

vector2D SeamBisection::parameterOnSide(const point& x, const SheetPoint& side) const
{
    const SurfacePoint foot = footOnSide(x, side);
    return foot.triangle < 0 ? side.sheet.p : sheets_.at(foot).p;
}

} // namespace Foam::stability
