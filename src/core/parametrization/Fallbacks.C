// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Fallbacks.H"

#include <algorithm>

namespace Foam::stability
{

std::string
failureText(const RemeshingResult& copy, const Chart& chart, const std::string& method)
{
    std::string text;
    if (!copy.failure.empty())
    {
        text = "remeshing failed (" + copy.failure + "), it stays as it is";
    }
    if (chart.fallback)
    {
        text +=
            (text.empty() ? "" : "; ") + method + " failed (" + chart.failure + "), ";
        text += chart.parameters.empty() ? "it gets no parameters" : "tutte was taken";
    }
    return text;
}

std::vector<ParametrizationFallback>
gathered(const std::vector<ParametrizationFallback>& here, const Exchange& exchange)
{
    Packet mine;
    for (const ParametrizationFallback& fallback : here)
    {
        mine.put(fallback.patch);
        mine.put(fallback.nTriangles);
        mine.put(fallback.centre);
        mine.putString(fallback.what);
    }
    std::vector<ParametrizationFallback> all;
    for (Packet& packet : exchange.toMaster(std::move(mine)))
    {
        while (!packet.atEnd())
        {
            ParametrizationFallback fallback;
            fallback.patch = packet.get<label>();
            fallback.nTriangles = packet.get<label>();
            fallback.centre = packet.get<point>();
            fallback.what = packet.getString();
            all.push_back(std::move(fallback));
        }
    }
    std::sort(
        all.begin(), all.end(),
        [](const auto& a, const auto& b) { return a.patch < b.patch; }
    );
    return all;
}

} // namespace Foam::stability
