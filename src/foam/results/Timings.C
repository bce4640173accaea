// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/Timings.H"

namespace Foam::stability
{

namespace
{

TableColumn<TimingRow>
phaseColumn(Phase phase, const std::string& meaning, scalar Timings::*seconds)
{
    return {
        phaseNames()[std::size_t(phase)], "s", meaning,
        [seconds](const TimingRow& row)
        { return row.now.*seconds - row.before.*seconds; }};
}

} // namespace

const TableLayout<TimingRow>& timingTable()
{
    using T = Timings;
    static const TableLayout<TimingRow> table{
        "timing.dat",
        "Seconds of wall-clock time, by phase, since the last classified time",
        {
            {"Time", "s", "the classified time", &TimingRow::time},
            phaseColumn(Phase::reading, "fields from disk or solver", &T::reading),
            phaseColumn(
                Phase::reconstruction, "M and its noise floor", &T::reconstruction
            ),
            phaseColumn(
                Phase::parametrization, "the first interface flattened",
                &T::parametrization
            ),
            phaseColumn(Phase::advection, "T carried with the flow", &T::advection),
            phaseColumn(
                Phase::particles, "instability particles shed and carried",
                &T::particles
            ),
            phaseColumn(
                Phase::matching, "nearest points of M and T, and the classes",
                &T::matching
            ),
            phaseColumn(
                Phase::transfer, "parameters and origins from T to M, seams cut",
                &T::transfer
            ),
            phaseColumn(Phase::statistics, "the numbers of the tables", &T::statistics),
            phaseColumn(Phase::writing, "tables and files written", &T::writing),
        }};
    return table;
}

} // namespace Foam::stability
