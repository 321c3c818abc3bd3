// SPDX-License-Identifier: Apache-2.0
#include "RefusedValues.h"

#include "Journal.h"
#include "realtime/TimeSource.h"

#include <utility>

namespace qplc {

namespace {

constexpr int lookPeriod = 250;  // [ms]

QString alarmOf(const QString &signal)
{
    return QStringLiteral("value of ") + signal;
}

}  // namespace

RefusedValues::RefusedValues(Journal &journal, Count count)
    : m_journal(journal)
    , m_count(std::move(count))
{
    m_timer.setInterval(lookPeriod);
    connect(&m_timer, &QTimer::timeout, this, &RefusedValues::look);
}

void RefusedValues::refused(QPlcSignalIndex signal, const QString &name, const QString &node, const QString &what)
{
    const bool isNew = !m_rows.contains(signal);
    m_rows.insert(signal, {name, node, what, m_count(signal), monotonicNow()});
    m_timer.start();
    if (isNew)
        m_journal.raise(alarmOf(name), JournalEvent::Warning, JournalEvent::Quality, node,
                        QStringLiteral("%1 of %2: %3; held").arg(name, node, what));
}

void RefusedValues::look()
{
    for (auto row = m_rows.begin(); row != m_rows.end();) {
        const std::uint64_t count = m_count(row.key());
        if (count != row->count) {
            row->count = count;
            row->since = monotonicNow();
        }
        if (monotonicNow() - row->since < CalmTime) {
            ++row;
            continue;
        }
        clear(row.key(), *row);
        row = m_rows.erase(row);
    }
    if (m_rows.isEmpty())
        m_timer.stop();
}

void RefusedValues::clear(QPlcSignalIndex signal, const Row &row)
{
    const std::uint64_t count = m_count(signal);
    const std::uint64_t ofRow = count - m_told.value(signal);
    m_told.insert(signal, count);
    m_journal.clear(alarmOf(row.name),
                    QStringLiteral("%1 of %2: no more values are refused; refused: %3, the last one: %4")
                        .arg(row.name, row.node)
                        .arg(ofRow)
                        .arg(row.last));
}

void RefusedValues::end()
{
    m_timer.stop();
    for (auto row = m_rows.cbegin(); row != m_rows.cend(); ++row)
        clear(row.key(), *row);
    m_rows.clear();
    m_told.clear();
}

}  // namespace qplc
