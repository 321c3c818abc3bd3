// SPDX-License-Identifier: Apache-2.0
#include "MessageText.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace qplc {

namespace {

constexpr int longestQuotation = 60;
constexpr int longestComparedName = 80;

// Letters to insert, remove, replace or swap with their neighbour (optimal string alignment); more
// than `limit` (any such number) when there are more. Both names are in lower case.
int editDistance(const QString &a, const QString &b, int limit)
{
    if (qAbs(a.size() - b.size()) > limit || qMax(a.size(), b.size()) >= longestComparedName)
        return limit + 1;
    std::array<std::array<int, longestComparedName>, 3> rows;
    for (int j = 0; j <= b.size(); ++j)
        rows[0][std::size_t(j)] = j;
    for (int i = 1; i <= a.size(); ++i) {
        auto &row = rows[std::size_t(i % 3)];
        const auto &above = rows[std::size_t((i + 2) % 3)];
        const auto &twoAbove = rows[std::size_t((i + 1) % 3)];
        int best = row[0] = i;
        for (int j = 1; j <= b.size(); ++j) {
            const auto column = std::size_t(j);
            const int replaced = above[column - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[column] = std::min({replaced, above[column] + 1, row[column - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[column] = std::min(row[column], twoAbove[column - 2] + 1);
            best = std::min(best, row[column]);
        }
        if (best > limit)
            return limit + 1;
    }
    return rows[std::size_t(a.size() % 3)][std::size_t(b.size())];
}

QStringList namesThatBeginAlike(const QString &name, const QStringList &candidates, int count)
{
    constexpr int shortest = 3;
    QStringList result;
    for (const QString &candidate : candidates) {
        const bool isLonger = name.size() >= shortest && candidate.startsWith(name, Qt::CaseInsensitive);
        const bool isShorter = candidate.size() >= shortest && name.startsWith(candidate, Qt::CaseInsensitive);
        if ((isLonger || isShorter) && result.size() < count)
            result.append(candidate);
    }
    return result;
}

bool isPrintable(uint character)
{
    switch (QChar::category(character)) {
    case QChar::Other_Control:
    case QChar::Other_Format:
    case QChar::Other_Surrogate:
    case QChar::Other_PrivateUse:
    case QChar::Other_NotAssigned:
    case QChar::Separator_Line:
    case QChar::Separator_Paragraph:
        return false;
    default:
        return true;
    }
}

}  // namespace

QString printable(const QString &text, const std::function<QString(uint)> &escape)
{
    QString shown;
    shown.reserve(text.size());
    for (int i = 0; i < text.size(); ++i) {
        const QChar unit = text.at(i);
        const bool isPair = unit.isHighSurrogate() && i + 1 < text.size() && text.at(i + 1).isLowSurrogate();
        const uint character = isPair ? QChar::surrogateToUcs4(unit, text.at(i + 1)) : unit.unicode();
        if (!isPrintable(character))
            shown += escape(character);
        else
            shown.append(text.constData() + i, isPair ? 2 : 1);
        i += isPair ? 1 : 0;
    }
    return shown;
}

QString printable(const QString &text)
{
    return printable(text, [](uint) { return QStringLiteral("?"); });
}

QString quoted(const QString &text)
{
    return QLatin1Char('\'')
        + printable(text.size() > longestQuotation ? text.left(longestQuotation) + QStringLiteral("...") : text)
        + QLatin1Char('\'');
}

QStringList closeNames(const QString &name, const QStringList &candidates, int count)
{
    const QString lowerName = name.toLower();
    const int limit = qBound(1, name.size() * 2 / 5, 3);
    std::vector<std::pair<int, QString>> close;
    for (const QString &candidate : candidates) {
        if (qAbs(candidate.size() - name.size()) > limit)
            continue;
        const int distance = editDistance(lowerName, candidate.toLower(), limit);
        if (distance <= limit)
            close.emplace_back(distance, candidate);
    }
    if (close.empty())
        return namesThatBeginAlike(name, candidates, count);
    std::stable_sort(close.begin(), close.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    QStringList result;
    for (const auto &entry : close) {
        if (result.size() < count && entry.first <= close.front().first + 1)
            result.append(entry.second);
    }
    return result;
}

QString didYouMean(const QStringList &names)
{
    if (names.isEmpty())
        return QString();
    QString text = QStringLiteral("; did you mean ");
    for (int i = 0; i < names.size(); ++i) {
        if (i > 0)
            text += i + 1 == names.size() ? QStringLiteral(" or ") : QStringLiteral(", ");
        text += quoted(names.at(i));
    }
    return text + QLatin1Char('?');
}

QString firstOf(const QStringList &names, int most)
{
    const QString text = names.mid(0, most).join(QStringLiteral(", "));
    return names.size() > most ? text + QStringLiteral(" and %1 more").arg(names.size() - most) : text;
}

QString knownAre(QStringList names)
{
    if (names.isEmpty())
        return QStringLiteral("; there is none");
    names.sort();
    return QStringLiteral("; known are: ") + firstOf(names, 12);
}

}  // namespace qplc
