// SPDX-License-Identifier: Apache-2.0
#include "HistogramText.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tools {

namespace {

struct Bin
{
    double border;  // upper one, [ns]
    double count;
};

QVector<Bin> usedBins(const QVector<QPlcDistribution::Bin> &all)
{
    QVector<Bin> bins;
    for (const QPlcDistribution::Bin &bin : all) {
        if (bin.count > 0)
            bins.append({std::max(double(bin.upperBorder), 1.0), double(bin.count)});
    }
    return bins;
}

/// The borders of the rows, from below the first bin to above the last one.
QVector<double> rowBorders(double lowest, double highest)
{
    static const QVector<double> coarse{1.0, 2.0, 5.0};
    static const QVector<double> fine{1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.3, 8.0};
    constexpr double decade = 10.0;
    const QVector<double> &steps = highest / lowest < decade ? fine : coarse;
    QVector<double> borders;
    for (double unit = std::pow(decade, std::floor(std::log10(lowest)) - 1.0);; unit *= decade) {
        for (const double step : steps) {
            if (unit * step >= highest)
                return borders << unit * step;
            borders << unit * step;
        }
    }
}

/// Counts of the rows; row i ends at borders[i].
QVector<double> rowCounts(const QVector<Bin> &bins, const QVector<double> &borders)
{
    QVector<double> counts(borders.size(), 0.0);
    for (const Bin &bin : bins)
        counts[int(std::lower_bound(borders.begin(), borders.end(), bin.border) - borders.begin())] += bin.count;
    return counts;
}

/// A bar of eighths of a character; what is there is always seen.
QString bar(double share, int width)
{
    constexpr int eighths = 8;
    constexpr ushort fullBlock = 0x2588;  // the blocks of 1/8 ... 7/8 stand behind it, in falling order
    const int length = share > 0.0 ? std::max(1, int(std::lround(share * width * eighths))) : 0;
    QString text(length / eighths, QChar(fullBlock));
    if (length % eighths > 0)
        text += QChar(ushort(fullBlock + eighths - length % eighths));
    return text;
}

}  // namespace

QString durationText(double nanoseconds)
{
    struct Unit
    {
        double size;
        const char *name;
    };
    constexpr Unit units[] = {{1e9, "s"}, {1e6, "ms"}, {1e3, "µs"}, {1.0, "ns"}};
    const double magnitude = std::abs(nanoseconds);
    for (const Unit &unit : units) {
        if (magnitude < unit.size * 0.9995 && unit.size > 1.0)
            continue;
        const double number = nanoseconds / unit.size;
        const int digits = unit.size == 1.0 || std::abs(number) >= 99.95 ? 0 : std::abs(number) >= 9.995 ? 1 : 2;
        return QStringLiteral("%1 %2").arg(number, 0, 'f', digits).arg(QString::fromUtf8(unit.name));
    }
    return {};
}

QStringList histogramLines(const QVector<QPlcDistribution::Bin> &all, int width)
{
    const QVector<Bin> bins = usedBins(all);
    if (bins.isEmpty())
        return {QStringLiteral("nothing recorded")};
    const auto [lowest, highest]
        = std::minmax_element(bins.begin(), bins.end(), [](const Bin &a, const Bin &b) { return a.border < b.border; });
    const QVector<double> borders = rowBorders(lowest->border, highest->border);
    const QVector<double> counts = rowCounts(bins, borders);
    const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
    const double most = *std::max_element(counts.begin(), counts.end());
    const auto isUsed = [](double count) { return count > 0.0; };
    const int first = int(std::find_if(counts.begin(), counts.end(), isUsed) - counts.begin());
    constexpr int textWidth = 12 + 12 + 11;  // border, count, share and blanks
    constexpr int longestGap = 6;            // two decades
    QStringList lines;
    for (int i = first; i < counts.size(); ++i) {
        const int next = int(std::find_if(counts.begin() + i, counts.end(), isUsed) - counts.begin());
        if (next - i > longestGap) {
            lines << QStringLiteral("%1").arg(QStringLiteral("..."), 11);
            i = next;
        }
        lines << QStringLiteral("<= %1 %2 %3 %  %4")
                     .arg(durationText(borders.at(i)), 8)
                     .arg(counts.at(i), 11, 'f', 0)
                     .arg(100.0 * counts.at(i) / total, 7, 'f', 3)
                     .arg(bar(counts.at(i) / most, std::max(width - textWidth, 5)));
    }
    return lines;
}

}  // namespace tools
