// SPDX-License-Identifier: Apache-2.0
// Compares docs/design/model/tables.pml, the tables of states in Promela, with those of the code,
// or writes it.
#include "node/state/MasterStates.h"
#include "node/state/SlaveStates.h"

#include <QtCore/QFile>
#include <QtCore/QStringList>

#include <cstdio>

namespace {

using namespace qplc;

/// Words of one of the two tables.
struct Words
{
    const char *table;   // of the inline
    const char *state;   // before the name of a state
    const char *event;   // before the name of an event
    const char *action;  // before the name of an action
};
constexpr Words ofMaster{"masterTable", "M_", "ME_", "MA_"};
constexpr Words ofNode{"nodeTable", "N_", "NE_", "NA_"};

/// "None", which has no name on the page of the states, needs one here.
template<typename Action>
QString actionName(Action action)
{
    const QString name = QString::fromLatin1(nameOf(action));
    return name.isEmpty() ? QStringLiteral("None") : name;
}

QString definition(const char *prefix, const QString &name, std::size_t number)
{
    return QStringLiteral("#define %1%2 %3\n").arg(QLatin1String(prefix), name).arg(number);
}

template<typename Table, typename State, typename Event>
QString outcome(const Words &words, const Table &table, State state, Event event)
{
    const auto &cell = table.at(state, event);
    if (cell.verdict == Verdict::Ignored)
        return QStringLiteral("ignore()");
    if (cell.verdict == Verdict::Refused)
        return QStringLiteral("refuse()");
    const QString action = QLatin1String(words.action) + actionName(cell.action);
    return cell.next == state
        ? QStringLiteral("stay(%1)").arg(action)
        : QStringLiteral("go(%1%2, %3)").arg(QLatin1String(words.state), QLatin1String(nameOf(cell.next)), action);
}

/// An option for each outcome of an event, with the states that have it.
template<typename State, typename Event, typename Table>
QString options(const Words &words, const Table &table, Event event)
{
    QStringList outcomes;
    QVector<QStringList> states;
    for (std::size_t s = 0; s < Table::StateCount; ++s) {
        const QString then = outcome(words, table, State(s), event);
        if (!outcomes.contains(then)) {
            outcomes << then;
            states << QStringList();
        }
        states[outcomes.indexOf(then)]
            << QStringLiteral("state == %1%2").arg(QLatin1String(words.state), QLatin1String(nameOf(State(s))));
    }
    QString lines;
    for (int i = 0; i < outcomes.size(); ++i)
        lines += QStringLiteral("        :: %1 -> %2\n").arg(states[i].join(QStringLiteral(" || ")), outcomes[i]);
    return lines;
}

template<typename State, typename Event, typename Action, typename Table>
QString text(const Words &words, const Table &table, Action last)
{
    QString lines;
    for (std::size_t s = 0; s < Table::StateCount; ++s)
        lines += definition(words.state, QString::fromLatin1(nameOf(State(s))), s);
    lines += QLatin1Char('\n');
    for (std::size_t e = 0; e < Table::EventCount; ++e)
        lines += definition(words.event, QString::fromLatin1(nameOf(Event(e))), e);
    lines += QLatin1Char('\n');
    for (std::size_t a = 0; a <= std::size_t(last); ++a)
        lines += definition(words.action, actionName(Action(a)), a);
    lines += QStringLiteral("\ninline %1(state, event)\n{\n    if\n").arg(QLatin1String(words.table));
    for (std::size_t e = 0; e < Table::EventCount; ++e)
        lines += QStringLiteral("    :: event == %1%2 ->\n        if\n%3        fi\n")
                     .arg(QLatin1String(words.event), QLatin1String(nameOf(Event(e))),
                          options<State>(words, table, Event(e)));
    return lines + QStringLiteral("    fi\n}\n");
}

QString document()
{
    return QStringLiteral("/* SPDX-License-Identifier: Apache-2.0\n"
                          "   The tables of states of master and node. Written by tests/states/promela_tables from\n"
                          "   src/node/state; do not edit. */\n\n"
                          "#define Accepted 0\n#define Ignored 1\n#define Refused 2\n\n"
                          "#define go(next, what) verdict = Accepted; state = next; action = what\n"
                          "#define stay(what) verdict = Accepted; action = what\n"
                          "#define ignore() verdict = Ignored; action = 0\n"
                          "#define refuse() verdict = Refused; action = 0\n\n")
        + text<QPlcMasterNode::State, MasterEvent>(ofMaster, masterStates(), MasterAction::LetJoin) + QLatin1Char('\n')
        + text<QPlcSlaveNode::State, SlaveEvent>(ofNode, slaveStates(), SlaveAction::EndCycles);
}

}  // namespace

int main(int argc, char **argv)
{
    const bool writes = argc == 3 && qstrcmp(argv[1], "--write") == 0;
    if (argc != 2 && !writes) {
        std::fprintf(stderr, "usage: promela_tables [--write] docs/design/model/tables.pml\n");
        return 2;
    }
    QFile file(QString::fromLocal8Bit(argv[argc - 1]));
    const QByteArray tables = document().toUtf8();
    if (writes)
        return file.open(QIODevice::WriteOnly) && file.write(tables) == tables.size() ? 0 : 1;
    if (file.open(QIODevice::ReadOnly) && file.readAll() == tables)
        return 0;
    std::fprintf(stderr,
                 "the model of the states has other tables than the code; remedy: promela_tables --write %s, then "
                 "docs/design/model/check.py\n",
                 argv[argc - 1]);
    return 1;
}
