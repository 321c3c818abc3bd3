// SPDX-License-Identifier: Apache-2.0
#include "ThreadCosts.h"
#include "gui/plot/PixelSpans.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <random>
#include <vector>

using qplc::PixelSpans;

namespace {

const QRect clip(0, 0, 40, 30);

/// How often each pixel is filled.
std::vector<int> pixelsOf(const PixelSpans &spans)
{
    std::vector<int> pixels(std::size_t(clip.width() * clip.height()));
    for (const QRect &rectangle : spans.rectangles()) {
        for (int y = rectangle.top(); y <= rectangle.bottom(); ++y) {
            for (int x = rectangle.left(); x <= rectangle.right(); ++x)
                ++pixels[std::size_t(y * clip.width() + x)];
        }
    }
    return pixels;
}

/// The rows from \a top to \a bottom that are filled in a column, as one number for comparisons; -1
/// when they are not one piece.
QPoint columnOf(const std::vector<int> &pixels, int x)
{
    int top = -1;
    int bottom = -1;
    for (int y = 0; y < clip.height(); ++y) {
        if (pixels[std::size_t(y * clip.width() + x)] == 0)
            continue;
        if (top >= 0 && bottom != y - 1)
            return {-2, -2};
        top = top < 0 ? y : top;
        bottom = y;
    }
    return {top, bottom};
}

}  // namespace

class tst_PixelSpans : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void emptyLineFillsNoPixel();
    void onePixelIsADot();
    void singlePixelAtALineIsNotThickened();
    void horizontalLineIsOneRectangle();
    void neighboursMeetHalfWay();
    void linesHaveNoHolesAndFillNoPixelTwice_data();
    void linesHaveNoHolesAndFillNoPixelTwice();
    void lineHasTheRequestedThickness();
    void tallColumnsAreFilledExactly();
    void gapStaysOpen();
    void spansStayWithinTheClip();
    void farAwayLinesPassThroughTheClip();
    void beginDiscardsTheUnfinishedLine();
    void dashesFollowTheirPattern();
    void dashesKeepPeaksFromEndToEnd();
    void dashesFillNoPixelTwice();
    void shortLinesHaveNoDashes();
};

void tst_PixelSpans::emptyLineFillsNoPixel()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    spans.endLine();
    QVERIFY(spans.rectangles().empty());
}

void tst_PixelSpans::onePixelIsADot()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    spans.moveTo(10, 10, 10);
    spans.endLine();
    QCOMPARE(spans.rectangles(), std::vector<QRect>{QRect(9, 9, 3, 3)});
}

/// Cycles that were lost within a pixel are no lump on the line.
void tst_PixelSpans::singlePixelAtALineIsNotThickened()
{
    PixelSpans spans;
    for (const int pixel : {10, 14, 16}) {
        spans.begin(clip, 1);
        spans.moveTo(0, 10, 10);
        spans.lineTo(0, 10, 9, 10);
        spans.moveTo(pixel, 10, 10);
        spans.moveTo(15, 10, 10);
        spans.lineTo(15, 10, 20, 10);
        spans.endLine();
        QCOMPARE(columnOf(pixelsOf(spans), pixel), QPoint(10, 10));
    }
    for (const QPoint far : {QPoint(12, 10), QPoint(10, 20)}) {
        spans.begin(clip, 1);
        spans.moveTo(0, 10, 10);
        spans.lineTo(0, 10, 9, 10);
        spans.moveTo(far.x(), far.y(), far.y());
        spans.moveTo(15, 10, 10);
        spans.endLine();
        QCOMPARE(columnOf(pixelsOf(spans), far.x()), QPoint(far.y() - 1, far.y() + 1));
    }
}

void tst_PixelSpans::horizontalLineIsOneRectangle()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    spans.moveTo(5, 10, 10);
    spans.lineTo(5, 10, 20, 10);
    spans.endLine();
    QCOMPARE(spans.rectangles(), std::vector<QRect>{QRect(5, 10, 16, 1)});
}

void tst_PixelSpans::neighboursMeetHalfWay()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    spans.moveTo(5, 2, 4);
    spans.lineTo(5, 4, 6, 20);
    spans.include(20, 22);
    spans.endLine();
    const std::vector<QRect> expected{QRect(QPoint(5, 2), QPoint(5, 12)), QRect(QPoint(6, 12), QPoint(6, 22))};
    QCOMPARE(spans.rectangles(), expected);
}

void tst_PixelSpans::linesHaveNoHolesAndFillNoPixelTwice_data()
{
    QTest::addColumn<int>("thickness");
    for (const int thickness : {1, 2, 3, 4, 5, 8})
        QTest::addRow("%d px", thickness) << thickness;
}

void tst_PixelSpans::linesHaveNoHolesAndFillNoPixelTwice()
{
    QFETCH(int, thickness);
    std::minstd_rand random(1);
    for (int trial = 0; trial < 300; ++trial) {
        PixelSpans spans;
        spans.begin(clip, thickness);
        int x = 0;
        int y = int(random() % 30);
        spans.moveTo(x, y, y);
        while (x < 39) {
            const int nextX = std::min(39, x + int(random() % 6));
            const int nextY = int(random() % 30);
            spans.lineTo(x, y, nextX, nextY);
            x = nextX;
            y = nextY;
        }
        spans.endLine();
        const std::vector<int> pixels = pixelsOf(spans);
        QVERIFY(*std::max_element(pixels.begin(), pixels.end()) == 1);
        for (int column = 0; column < 40; ++column) {
            const QPoint span = columnOf(pixels, column);
            QVERIFY(span.x() >= 0);
            if (column == 0)
                continue;
            const QPoint left = columnOf(pixels, column - 1);
            QVERIFY(left.x() <= span.y() + 1 && span.x() <= left.y() + 1);
        }
    }
}

void tst_PixelSpans::lineHasTheRequestedThickness()
{
    for (int thickness = 1; thickness < 8; ++thickness) {
        PixelSpans spans;
        spans.begin(clip, thickness);
        spans.moveTo(10, 15, 15);
        spans.lineTo(10, 15, 20, 15);
        spans.endLine();
        QCOMPARE(spans.rectangles().size(), std::size_t(1));
        QCOMPARE(spans.rectangles().front().size(), QSize(10 + thickness, thickness));
        QVERIFY(spans.rectangles().front().contains(QRect(10, 15, 11, 1)));
    }
}

void tst_PixelSpans::tallColumnsAreFilledExactly()
{
    std::minstd_rand random(2);
    for (int trial = 0; trial < 300; ++trial) {
        PixelSpans spans;
        spans.begin(clip, 1);
        std::vector<QPoint> expected;
        for (int x = 0; x < clip.width(); ++x) {
            const QPoint span(int(random() % 6), 29 - int(random() % 6));
            if (x == 0)
                spans.moveTo(x, span.x(), span.y());
            else
                spans.lineTo(x - 1, 15, x, 15);
            spans.include(span.x(), span.y());
            expected.push_back(span);
        }
        spans.endLine();
        const std::vector<int> pixels = pixelsOf(spans);
        QCOMPARE(*std::max_element(pixels.begin(), pixels.end()), 1);
        for (int x = 0; x < clip.width(); ++x)
            QCOMPARE(columnOf(pixels, x), expected[std::size_t(x)]);
        QVERIFY(spans.rectangles().size() < 3 * expected.size());
    }
}

void tst_PixelSpans::gapStaysOpen()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    spans.moveTo(5, 10, 12);
    spans.moveTo(8, 10, 12);
    spans.endLine();
    const std::vector<int> pixels = pixelsOf(spans);
    QCOMPARE(columnOf(pixels, 5), QPoint(10, 12));
    QCOMPARE(columnOf(pixels, 6), QPoint(-1, -1));
    QCOMPARE(columnOf(pixels, 7), QPoint(-1, -1));
    QCOMPARE(columnOf(pixels, 8), QPoint(10, 12));
}

void tst_PixelSpans::spansStayWithinTheClip()
{
    PixelSpans spans;
    spans.begin(clip, 3);
    spans.moveTo(-20, -50, 500);
    spans.lineTo(-20, 10, 80, 10);
    spans.endLine();
    spans.moveTo(10, 31, 60);
    spans.moveTo(90, 3, 6);
    spans.endLine();
    for (const QRect &rectangle : spans.rectangles())
        QVERIFY(clip.contains(rectangle));
    QCOMPARE(columnOf(pixelsOf(spans), 39), QPoint(9, 11));
}

void tst_PixelSpans::farAwayLinesPassThroughTheClip()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    const ThreadCosts before = ThreadCosts::ofThisThread();
    spans.moveTo(-1'000'000, 15, 15);
    spans.lineTo(-1'000'000, 15, 1'000'000, 15);
    spans.lineTo(1'000'000, 15, 1'000'000, -1'000'000);
    spans.lineTo(1'000'000, -1'000'000, 1'000'001, 3);
    spans.include(3, 8);
    spans.endLine();
    QCOMPARE((ThreadCosts::ofThisThread() - before).allocations, std::uint64_t(0));  // nor a long way
    QCOMPARE(spans.rectangles(), std::vector<QRect>{QRect(0, 15, 40, 1)});
}

void tst_PixelSpans::beginDiscardsTheUnfinishedLine()
{
    PixelSpans spans;
    spans.begin(clip, 1);
    spans.moveTo(5, 10, 12);
    spans.begin(clip, 1);
    spans.endLine();
    QVERIFY(spans.rectangles().empty());
}

void tst_PixelSpans::dashesFollowTheirPattern()
{
    PixelSpans spans;
    for (const int first : {-3, 5, 13}) {
        spans.begin(clip, 1, {5, 3, first});
        spans.moveTo(0, 10, 10);
        spans.lineTo(0, 10, 39, 10);
        spans.endLine();
        const std::vector<int> pixels = pixelsOf(spans);
        for (int x = 0; x < clip.width(); ++x) {
            const bool isOn = (x + 16 - first) % 8 < 5;
            QCOMPARE(columnOf(pixels, x), isOn ? QPoint(10, 10) : QPoint(-1, -1));
        }
        QVERIFY(spans.rectangles().size() <= 6);
    }
}

void tst_PixelSpans::dashesKeepPeaksFromEndToEnd()
{
    for (int x = 1; x < 39; ++x) {
        PixelSpans spans;
        spans.begin(clip, 1, {5, 3, 0});
        spans.moveTo(0, 25, 25);
        spans.lineTo(0, 25, x, 25);
        spans.include(2, 25);
        spans.lineTo(x, 25, 39, 25);
        spans.endLine();
        const std::vector<int> pixels = pixelsOf(spans);
        const auto isSet = [&](int y) { return pixels[std::size_t(y * clip.width() + x)] > 0; };
        QVERIFY(isSet(2) && isSet(25));
        int set = 0;
        for (int y = 2; y <= 25; ++y)
            set += isSet(y) ? 1 : 0;
        QVERIFY(set >= 24 * 5 / 8 && set <= (x % 8 < 5 ? 24 : 20));
    }
}

void tst_PixelSpans::dashesFillNoPixelTwice()
{
    std::minstd_rand random(3);
    for (int trial = 0; trial < 300; ++trial) {
        PixelSpans spans;
        const int thickness = 1 + int(random() % 4);
        spans.begin(clip, thickness, {5 * thickness, 3 * thickness, int(random() % 20)});
        int y = int(random() % 30);
        spans.moveTo(0, y, y);
        for (int x = 0; x < 39; ++x) {
            const int nextY = int(random() % 30);
            spans.lineTo(x, y, x + 1, nextY);
            y = nextY;
        }
        spans.endLine();
        const std::vector<int> pixels = pixelsOf(spans);
        QCOMPARE(*std::max_element(pixels.begin(), pixels.end()), 1);
        QVERIFY(spans.rectangles().size() < std::size_t(clip.width() * (2 + clip.height() / (8 * thickness))));
        for (const QRect &rectangle : spans.rectangles())
            QVERIFY(clip.contains(rectangle));
    }
}

void tst_PixelSpans::shortLinesHaveNoDashes()
{
    for (int first = 0; first < 8; ++first) {
        PixelSpans spans;
        spans.begin(clip, 1, {5, 3, first});
        spans.moveTo(20, 10, 10);
        spans.lineTo(20, 10, 24, 10);
        spans.endLine();
        QCOMPARE(spans.rectangles(), std::vector<QRect>{QRect(20, 10, 5, 1)});
    }
}

QTEST_APPLESS_MAIN(tst_PixelSpans)
#include "tst_PixelSpans.moc"
