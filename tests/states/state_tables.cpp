// SPDX-License-Identifier: Apache-2.0
// Compares the tables in docs/design/states.md with those of the code, or writes them there.
#include "node/state/MasterStates.h"
#include "node/state/SlaveStates.h"

#include <QtCore/QFile>
#include <QtCore/QStringList>

#include <cstdio>

namespace {

using namespace qplc;

template<typename Table, typename State, typename Event>
QString outcome(const Table &table, State state, Event event)
{
    const auto &cell = table.at(state, event);
    if (cell.verdict == Verdict::Ignored)
        return QStringLiteral("ignored");
    if (cell.verdict == Verdict::Refused)
        return QStringLiteral("refused: %1").arg(QLatin1String(cell.text));
    const QString next = cell.next == state ? QStringLiteral("stays") : QStringLiteral("**%1**").arg(nameOf(cell.next));
    const QString action = QString::fromLatin1(nameOf(cell.action));
    return action.isEmpty() ? next : QStringLiteral("%1, %2").arg(next, action);
}

/// A line for each outcome of each event, with the states that have it.
template<typename State, typename Event, typename Table>
QString text(const Table &table)
{
    QString lines = QStringLiteral("| event | in state | then |\n|---|---|---|\n");
    for (std::size_t e = 0; e < Table::EventCount; ++e) {
        QStringList outcomes;
        QVector<QStringList> states;
        for (std::size_t s = 0; s < Table::StateCount; ++s) {
            const QString then = outcome(table, State(s), Event(e));
            if (!outcomes.contains(then)) {
                outcomes << then;
                states << QStringList();
            }
            states[outcomes.indexOf(then)] << QString::fromLatin1(nameOf(State(s)));
        }
        for (int i = 0; i < outcomes.size(); ++i)
            lines += QStringLiteral("| %1 | %2 | %3 |\n")
                         .arg(i == 0 ? QStringLiteral("`%1`").arg(nameOf(Event(e))) : QString(),
                              states[i].size() == int(Table::StateCount) ? QStringLiteral("every state")
                                                                         : states[i].join(QStringLiteral(", ")),
                              outcomes[i]);
    }
    return lines;
}

/// Puts \a lines between the marks of \a name. \return false when there are none
bool replaceTable(QString *page, const char *name, const QString &lines)
{
    const QString begin = QStringLiteral("<!-- states: %1 -->\n").arg(QLatin1String(name));
    const QString end = QStringLiteral("<!-- end of states -->");
    const int from = page->indexOf(begin);
    const int to = page->indexOf(end, from);
    if (from < 0 || to < 0)
        return false;
    page->replace(from + begin.size(), to - from - begin.size(), lines);
    return true;
}

}  // namespace

int main(int argc, char **argv)
{
    const bool writes = argc == 3 && qstrcmp(argv[1], "--write") == 0;
    QFile file(QString::fromLocal8Bit(argv[argc - 1]));
    if ((argc != 2 && !writes) || !file.open(QIODevice::ReadOnly)) {
        std::fprintf(stderr, "usage: state_tables [--write] docs/design/states.md\n");
        return 2;
    }
    const QString present = QString::fromUtf8(file.readAll());
    file.close();
    QString page = present;
    if (!replaceTable(&page, "master", text<QPlcMasterNode::State, MasterEvent>(masterStates()))
        || !replaceTable(&page, "node", text<QPlcSlaveNode::State, SlaveEvent>(slaveStates()))) {
        std::fprintf(stderr, "the page lacks the marks of its tables\n");
        return 1;
    }
    if (page == present)
        return 0;
    if (!writes) {
        std::fprintf(stderr, "the page shows other tables than the code has; remedy: state_tables --write %s\n",
                     argv[argc - 1]);
        return 1;
    }
    return file.open(QIODevice::WriteOnly) && file.write(page.toUtf8()) > 0 ? 0 : 1;
}
