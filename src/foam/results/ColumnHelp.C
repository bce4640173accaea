// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ColumnHelp.H"

#include "core/comparison/StabilityTables.H"
#include "core/comparison/SubGridDroplets.H"
#include "core/parametrization/ChartReport.H"
#include "core/results/MethodScore.H"
#include "foam/results/Timings.H"

namespace Foam::stability
{

namespace
{

template<class Row>
std::string listOf(const TableLayout<Row>& table)
{
    std::string text = "Columns of `" + table.file
                       + "`:\n\n| column | unit | meaning |\n|---|---|---|\n";
    const std::vector<TableColumn<Row>>& columns = table.columns;
    const auto sameAsNext = [&](std::size_t i)
    {
        return i + 1 < columns.size() && columns[i].unit == columns[i + 1].unit
               && columns[i].meaning == columns[i + 1].meaning;
    };
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        text += (i > 0 && sameAsNext(i - 1) ? ", `" : "| `") + columns[i].name + '`';
        if (!sameAsNext(i))
        {
            text += " | " + columns[i].unit + " | " + columns[i].meaning + " |\n";
        }
    }
    return text;
}

} // namespace

std::string listOfColumns()
{
    return listOf(stabilityTable()) + '\n' + listOf(survivalTable()) + '\n'
           + listOf(dropletTable()) + '\n' + listOf(chartTable()) + '\n'
           + listOf(timingTable()) + '\n' + listOf(methodTable());
}

} // namespace Foam::stability
