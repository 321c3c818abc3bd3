// SPDX-License-Identifier: Apache-2.0
#include "FuzzyMatch.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <algorithm>

namespace qplc {

namespace {

constexpr int noFit = -1'000'000;
constexpr int hit = 4;
constexpr int inRun = 12;
constexpr int atBegin = 16;
constexpr int atEnd = 4;

bool isBeginOfWord(const QString &text, int place)
{
    if (place == 0)
        return true;
    const QChar before = text.at(place - 1);
    return !before.isLetterOrNumber() || (before.isLower() && text.at(place).isUpper());
}

bool isEndOfWord(const QString &text, int place)
{
    return place + 1 == text.size() || !text.at(place + 1).isLetterOrNumber();
}

/// Best sum over all ways to find the letters of \a word in \a text.
int wordScore(const QString &word, const QString &text)
{
    const int size = text.size();
    QVector<int> best(size, noFit);  // with the letter at hand found at this place
    for (int letter = 0; letter < word.size(); ++letter) {
        QVector<int> next(size, noFit);
        int bestBefore = letter == 0 ? 0 : noFit;  // of all places before
        for (int place = 0; place < size; ++place) {
            if (letter > 0 && place > 0)
                bestBefore = std::max(bestBefore, best[place - 1]);
            if (text.at(place).toCaseFolded() != word.at(letter).toCaseFolded() || bestBefore <= noFit)
                continue;
            const int run = letter > 0 && place > 0 && best[place - 1] > noFit ? best[place - 1] + inRun : noFit;
            next[place] = std::max(bestBefore, run) + hit + (isBeginOfWord(text, place) ? atBegin : 0);
        }
        best = next;
    }
    for (int place = 0; place < size; ++place) {
        if (best[place] > noFit && isEndOfWord(text, place))
            best[place] += atEnd;  // "large" is rather "Large targets" than "Larger values"
    }
    return size > 0 ? *std::max_element(best.begin(), best.end()) : noFit;
}

}  // namespace

int fuzzyScore(const QString &pattern, const QString &text)
{
    const QStringList words = pattern.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    int sum = 0;
    for (const QString &word : words) {
        const int score = wordScore(word, text);
        if (score < 0)
            return -1;
        sum += score;
    }
    return words.isEmpty() ? 0 : std::max(0, 8 * sum - text.size());
}

}  // namespace qplc
