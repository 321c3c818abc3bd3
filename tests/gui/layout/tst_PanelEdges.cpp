// SPDX-License-Identifier: Apache-2.0
// Panels have a line along each of their four edges, and paint every pixel of theirs, at all scale
// factors. This program runs once for each scale factor: see CMakeLists.txt.
#include "ViewFixtures.h"

#include <QtGui/QPainter>
#include <QtWidgets/QStyleFactory>

#include <cmath>

using namespace qplc;

namespace {

constexpr std::initializer_list<double> ratios{1.0, 1.25, 1.5, 1.75, 2.0};

QImage pictureOver(QWidget *view, const QColor &beneath, double ratio)
{
    QImage image((QSizeF(view->size()) * ratio).toSize(), QImage::Format_RGB32);
    image.setDevicePixelRatio(ratio);
    image.fill(beneath);
    view->render(&image, QPoint(), QRegion(), QWidget::DrawChildren);
    return image;
}

QRectF placeOf(const QWidget *part, const QWidget *view, double ratio)
{
    const QPointF corner = QPointF(part->mapTo(view, QPoint())) * ratio;
    return {corner, QSizeF(part->size()) * ratio};
}

/// The pixels of which nothing is outside of a place.
QRect wholePixels(const QRectF &place)
{
    const QPoint first(int(std::ceil(place.left())), int(std::ceil(place.top())));
    const QPoint end(int(std::floor(place.right())), int(std::floor(place.bottom())));
    return {first, end - QPoint(1, 1)};
}

/// The most pixels of a colour in one line along an edge of a place, of the lines that its frame
/// can be in.
int lineAlong(const QImage &picture, const QRectF &place, Qt::Edge edge, const QColor &color)
{
    const QRect whole = wholePixels(place);
    const bool isLying = edge == Qt::TopEdge || edge == Qt::BottomEdge;
    const bool isFirst = edge == Qt::TopEdge || edge == Qt::LeftEdge;
    const double size = picture.devicePixelRatio();
    const double begin
        = isLying ? (isFirst ? place.top() : place.bottom() - size) : (isFirst ? place.left() : place.right() - size);
    int most = 0;
    for (int line = int(std::floor(begin)); line < int(std::ceil(begin + size)); ++line) {
        int pixels = 0;
        for (int i = isLying ? whole.left() : whole.top(); i <= (isLying ? whole.right() : whole.bottom()); ++i) {
            const QPoint pixel = isLying ? QPoint(i, line) : QPoint(line, i);
            pixels += picture.rect().contains(pixel) && picture.pixelColor(pixel) == color ? 1 : 0;
        }
        most = std::max(most, pixels);
    }
    return most;
}

/// The middle of the line at the left, which is drawn at every scale.
QColor lineColor(const QWidget *part, const QWidget *view)
{
    QImage picture = pictureOver(const_cast<QWidget *>(view), Qt::magenta, 1.0);
    return picture.pixelColor(part->mapTo(view, QPoint(0, part->height() / 2)));
}

const std::initializer_list<QSize> sizes{QSize(1000, 700), QSize(999, 701), QSize(802, 603), QSize(805, 606)};

}  // namespace

class tst_PanelEdges : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void everyPanelHasFourLines();
    void panelsPaintAllPixels();
};

void tst_PanelEdges::initTestCase()
{
    const double wanted = qEnvironmentVariable("QT_SCALE_FACTOR", QStringLiteral("1")).toDouble();
    QCOMPARE(qApp->devicePixelRatio(), wanted);
    QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
}

void tst_PanelEdges::everyPanelHasFourLines()
{
    ViewFixture window;
    for (const QSize &size : sizes) {
        window.view.resize(size);
        QCoreApplication::processEvents();
        for (const double ratio : ratios) {
            const QImage picture = pictureOver(&window.view, Qt::magenta, ratio);
            for (const PanelFrame *frame : window.allFrames()) {
                const QColor line = lineColor(frame, &window.view);
                QVERIFY(line != QColor(Qt::magenta) && line != frame->palette().color(QPalette::Base));
                const QRectF place = placeOf(frame, &window.view, ratio);
                for (const Qt::Edge edge : {Qt::TopEdge, Qt::LeftEdge, Qt::BottomEdge, Qt::RightEdge}) {
                    const bool isLying = edge == Qt::TopEdge || edge == Qt::BottomEdge;
                    const int length = isLying ? wholePixels(place).width() : wholePixels(place).height();
                    const int pixels = lineAlong(picture, place, edge, line);
                    QVERIFY2(pixels == length,
                             qPrintable(QStringLiteral("%1, edge %2, %3 x %4 at %5: %6 of %7 pixels")
                                            .arg(frame->panelId())
                                            .arg(int(edge))
                                            .arg(size.width())
                                            .arg(size.height())
                                            .arg(ratio)
                                            .arg(pixels)
                                            .arg(length)));
                }
            }
        }
    }
}

void tst_PanelEdges::panelsPaintAllPixels()
{
    ViewFixture window;
    for (const QSize &size : sizes) {
        window.view.resize(size);
        QCoreApplication::processEvents();
        for (const double ratio : ratios) {
            const QImage magenta = pictureOver(&window.view, QColor(255, 0, 255), ratio);
            const QImage green = pictureOver(&window.view, QColor(0, 255, 0), ratio);
            for (const PanelFrame *frame : window.allFrames()) {
                const QRect whole = wholePixels(placeOf(frame, &window.view, ratio));
                int foreign = 0;
                for (int y = whole.top(); y <= whole.bottom(); ++y) {
                    for (int x = whole.left(); x <= whole.right(); ++x)
                        foreign += magenta.pixel(x, y) != green.pixel(x, y) ? 1 : 0;
                }
                QVERIFY2(foreign == 0,
                         qPrintable(QStringLiteral("%1 at %2: %3").arg(frame->panelId()).arg(ratio).arg(foreign)));
            }
        }
    }
}

QTEST_MAIN(tst_PanelEdges)
#include "tst_PanelEdges.moc"
