// SPDX-License-Identifier: Apache-2.0
#include "GpioLineWords.h"

#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QRegularExpression>

namespace qplc {

namespace {

constexpr qint64 LongestDebounce = 1'000'000'000;  // [ns]

/// "5 ms", "250us", "0.01 s" [ns]; -1: something else
qint64 debounceTime(const QString &text)
{
    static const QRegularExpression form(QStringLiteral("^[0-9]+(?:\\.[0-9]+)? ?(?:us|ms|s)$"));
    double time = 0.0;
    if (!form.match(text).hasMatch() || !durationFromText(text, &time))
        return -1;
    return time <= double(LongestDebounce) ? qint64(time) : -1;
}

bool readPull(const QString &word, GpioLineRequest::Pull *pull)
{
    if (word == QLatin1String("pull-up"))
        *pull = GpioLineRequest::PullUp;
    else if (word == QLatin1String("pull-down"))
        *pull = GpioLineRequest::PullDown;
    else if (word == QLatin1String("no-pull"))
        *pull = GpioLineRequest::NoPull;
    else
        return false;
    return true;
}

bool readEdges(const QString &word, GpioLineWords::Edges *edges)
{
    if (word == QLatin1String("edges rising"))
        *edges = GpioLineWords::Rising;
    else if (word == QLatin1String("edges falling"))
        *edges = GpioLineWords::Falling;
    else if (word == QLatin1String("edges both"))
        *edges = GpioLineWords::Both;
    else
        return false;
    return true;
}

bool readDebounce(const QString &word, qint64 *time)
{
    if (!word.startsWith(QLatin1String("debounce ")))
        return false;
    *time = debounceTime(word.mid(9).trimmed());
    return *time >= 0;
}

bool readInputWord(const QString &word, GpioLineWords *line)
{
    return readPull(word, &line->request.pull) || readEdges(word, &line->edges) || readDebounce(word, &line->debounce);
}

bool readOutputWord(const QString &word, GpioLineWords *line)
{
    if (word == QLatin1String("open-drain"))
        line->request.isOpenDrain = true;
    else if (word == QLatin1String("keep"))
        line->isKept = true;
    else
        return false;
    return true;
}

}  // namespace

QString GpioLineWords::read(const QStringList &words, bool isOutput, GpioLineWords *result)
{
    *result = GpioLineWords();
    result->request.isOutput = isOutput;
    result->request.line = words.value(0).trimmed();
    if (result->request.line.isEmpty())
        return QStringLiteral("the line is missing: its number or its name comes first, '17' or 'GPIO17'");
    for (const QString &text : words.mid(1)) {
        const QString word = text.simplified().toLower();
        if (word == QLatin1String("active-low"))
            result->request.isActiveLow = true;
        else if (!(isOutput ? readOutputWord(word, result) : readInputWord(word, result)))
            return isOutput
                ? QStringLiteral("%1 is not an option of an output; use active-low, open-drain, keep").arg(quoted(text))
                : QStringLiteral("%1 is not an option of an input; use active-low, pull-up, pull-down, "
                                 "no-pull, debounce 5 ms (at most 1 s), edges rising, edges falling, edges both")
                      .arg(quoted(text));
    }
    return QString();
}

}  // namespace qplc
