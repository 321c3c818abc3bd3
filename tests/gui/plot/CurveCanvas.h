// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/StoreCurve.h"

#include <QtGui/QImage>
#include <QtGui/QPainter>
#include <QtTest/QtTest>

#include <qwt_scale_map.h>

#include <limits>

constexpr float noValue = std::numeric_limits<float>::quiet_NaN();
constexpr qplc::SignalStore::Time millisecond = 1'000'000;
constexpr int width = 200;
constexpr int height = 100;

/// Rows one millisecond apart from 0 on.
template<typename ValueOf>
void fill(qplc::SignalStore *store, int rows, ValueOf valueOf)
{
    for (int i = 0; i < rows; ++i) {
        const float value = valueOf(i);
        QVERIFY(store->append(i * millisecond, &value));
    }
}

/// A canvas of 200 x 100 pixels; values 0 ... 100 are its rows from the bottom.
struct Canvas
{
    explicit Canvas(double scale = 1.0)
        : image(int(width * scale), int(height * scale), QImage::Format_RGB32)
    {
        image.setDevicePixelRatio(scale);
        image.fill(Qt::white);
        xMap.setPaintInterval(0, width);
        yMap.setPaintInterval(height, 0);
        yMap.setScaleInterval(0, height);
    }

    void draw(const qplc::StoreCurve &curve, double begin, double end)
    {
        xMap.setScaleInterval(begin, end);
        QPainter painter(&image);
        curve.draw(&painter, xMap, yMap, QRectF(0, 0, width, height));
    }
    bool isSet(int x, int y) const { return image.pixel(x, y) != qRgb(255, 255, 255); }
    /// The number of pixels of a column that are drawn.
    int count(int x) const
    {
        int pixels = 0;
        for (int y = 0; y < image.height(); ++y)
            pixels += isSet(x, y) ? 1 : 0;
        return pixels;
    }
    /// The number of pixels that are neither black nor white.
    int shades() const
    {
        int pixels = 0;
        for (int i = 0; i < image.width() * image.height(); ++i) {
            const int level = qGray(image.pixel(i % image.width(), i / image.width()));
            pixels += level > 0 && level < 255 ? 1 : 0;
        }
        return pixels;
    }

    QImage image;
    QwtScaleMap xMap;
    QwtScaleMap yMap;
};
