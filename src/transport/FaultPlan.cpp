// SPDX-License-Identifier: Apache-2.0
#include "FaultPlan.h"

#include <QtCore/QStringList>

namespace qplc {

namespace {

constexpr std::int64_t LongestDelay = 10'000'000'000;             // [ns]
constexpr std::int64_t LongestCut = 1'000'000 * 1'000'000'000LL;  // [ns]

using Direction = FaultPlan::Direction;

std::optional<double> share(const QString &text)
{
    bool isNumber = false;
    const double percent = text.endsWith(QLatin1Char('%')) ? text.chopped(1).toDouble(&isNumber) : 0.0;
    if (!isNumber || !(percent >= 0.0 && percent <= 100.0))
        return {};
    return percent / 100.0;
}

std::optional<std::int64_t> duration(const QString &text, std::int64_t longest)
{
    struct Unit
    {
        const char *name;
        double nanoseconds;
    };
    for (const Unit &unit : {Unit{"ns", 1.0}, Unit{"us", 1e3}, Unit{"ms", 1e6}, Unit{"s", 1e9}}) {
        if (!text.endsWith(QLatin1String(unit.name)))
            continue;
        bool isNumber = false;
        const double time = text.chopped(int(qstrlen(unit.name))).toDouble(&isNumber) * unit.nanoseconds;
        if (isNumber && time >= 0.0 && time <= double(longest))
            return std::int64_t(time + 0.5);
        if (isNumber)
            return {};
    }
    return {};
}

bool readShare(const QString &value, double Direction::*member, Direction *direction)
{
    const std::optional<double> read = share(value);
    direction->*member = read.value_or(0.0);
    return read.has_value();
}

bool readDuration(const QString &value, std::int64_t Direction::*member, Direction *direction)
{
    const std::optional<std::int64_t> read = duration(value, LongestDelay);
    direction->*member = read.value_or(0);
    return read.has_value();
}

bool readCut(const QString &value, Direction *direction)
{
    const int plus = value.indexOf(QLatin1Char('+'));
    const int slash = value.indexOf(QLatin1Char('/'));
    if (slash >= 0 && plus < 0)
        return false;
    const auto begin = duration(value.left(plus), LongestCut);
    const auto length = plus < 0 ? std::optional<std::int64_t>(0)
                                 : duration(value.mid(plus + 1, slash < 0 ? -1 : slash - plus - 1), LongestCut);
    const auto period = slash < 0 ? std::optional<std::int64_t>(0) : duration(value.mid(slash + 1), LongestCut);
    if (!begin || !length || !period || (plus >= 0 && *length == 0) || (slash >= 0 && *period <= *length))
        return false;
    direction->cutBegin = *begin;
    direction->cutLength = *length;
    direction->cutPeriod = *period;
    return true;
}

/// One kind of word: how its value is read, and what it should look like.
struct Word
{
    const char *key;
    bool (*read)(const QString &value, Direction *direction);
    const char *form;
};

const char shareForm[] = "a share of 0% ... 100%, for example 5%";
const char durationForm[] = "a time of 0 ... 10s, for example 2ms";

const Word words[] = {
    {"loss", [](const QString &v, Direction *d) { return readShare(v, &Direction::loss, d); }, shareForm},
    {"duplicate", [](const QString &v, Direction *d) { return readShare(v, &Direction::duplicate, d); }, shareForm},
    {"reorder", [](const QString &v, Direction *d) { return readShare(v, &Direction::reorder, d); }, shareForm},
    {"corrupt", [](const QString &v, Direction *d) { return readShare(v, &Direction::corrupt, d); }, shareForm},
    {"delay", [](const QString &v, Direction *d) { return readDuration(v, &Direction::delay, d); }, durationForm},
    {"jitter", [](const QString &v, Direction *d) { return readDuration(v, &Direction::jitter, d); }, durationForm},
    {"cut", &readCut, "BEGIN, BEGIN+LENGTH or BEGIN+LENGTH/PERIOD, for example 2s+500ms/10s"},
};

/// Why \a word cannot be meant; empty: it was read.
QString readWord(const QString &word, FaultPlan *plan)
{
    QString key = word.section(QLatin1Char('='), 0, 0).trimmed();
    const QString value = word.section(QLatin1Char('='), 1).trimmed();
    if (key == QLatin1String("seed")) {
        bool isNumber = false;
        plan->seed = value.toULongLong(&isNumber);
        return isNumber ? QString() : QStringLiteral("use a whole number, for example seed=7");
    }
    const bool onlySent = key.endsWith(QLatin1String("-sent"));
    const bool onlyReceived = key.endsWith(QLatin1String("-received"));
    if (onlySent || onlyReceived)
        key = key.section(QLatin1Char('-'), 0, 0);
    for (const Word &known : words) {
        if (key != QLatin1String(known.key))
            continue;
        const bool isRead
            = (onlyReceived || known.read(value, &plan->sent)) && (onlySent || known.read(value, &plan->received));
        return isRead ? QString() : QStringLiteral("use %1").arg(QLatin1String(known.form));
    }
    return QStringLiteral("use loss, duplicate, reorder, corrupt, delay, jitter, cut (each with -sent or -received "
                          "for one direction) or seed");
}

}  // namespace

bool FaultPlan::Direction::isNothing() const
{
    return loss <= 0.0 && duplicate <= 0.0 && reorder <= 0.0 && corrupt <= 0.0 && delay == 0 && jitter == 0
        && cutBegin < 0;
}

bool FaultPlan::Direction::isCut(std::int64_t elapsed) const noexcept
{
    if (cutBegin < 0 || elapsed < cutBegin)
        return false;
    if (cutLength == 0)
        return true;
    const std::int64_t since = elapsed - cutBegin;
    return (cutPeriod > 0 ? since % cutPeriod : since) < cutLength;
}

std::optional<FaultPlan> FaultPlan::fromText(const QString &text, QString *error)
{
    FaultPlan plan;
    const QStringList all = text.split(QLatin1Char(','), Qt::SkipEmptyParts);
    for (const QString &word : all) {
        const QString remedy = readWord(word, &plan);
        if (remedy.isEmpty())
            continue;
        *error = QStringLiteral("'%1': %2").arg(word.trimmed(), remedy);
        return {};
    }
    if (!plan.sent.isNothing() || !plan.received.isNothing())
        return plan;
    *error = QStringLiteral("'%1' has no fault; name one, for example loss=5%").arg(text);
    return {};
}

}  // namespace qplc
