// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactory.h"

#include <QtGui/QPainter>
#include <QtWidgets/QSpinBox>

#include <cmath>
#include <memory>
#include <vector>

/// A panel that draws a curve and has a setting, "waves"; "content" is what it says that it shows.
class DummyPanel : public QPlcWidget
{
    Q_OBJECT
public:
    explicit DummyPanel(int type, QWidget *parent = nullptr)
        : QPlcWidget(parent)
        , m_type(type)
    {
        setFocusPolicy(Qt::StrongFocus);
    }

    int type() const override { return m_type; }
    int waves() const { return m_waves; }
    /// As a person does in the settings.
    void editWaves(int waves)
    {
        m_waves = waves;
        update();
        Q_EMIT settingsEdited();
    }

    QJsonObject settings() const override
    {
        QJsonObject all = QPlcWidget::settings();
        all.insert(QStringLiteral("waves"), m_waves);
        return all;
    }
    void applySettings(const QJsonObject &settings) override
    {
        QPlcWidget::applySettings(settings);
        m_waves = settings.value(QStringLiteral("waves")).toInt(m_waves);
        setDefaultTitle(settings.value(QStringLiteral("content")).toString());
        update();
    }
    QWidget *createSettingsEditor() override
    {
        auto *editor = new QSpinBox;
        editor->setPrefix(QStringLiteral("waves: "));
        editor->setRange(1, 50);
        editor->setValue(m_waves);
        connect(editor, QOverload<int>::of(&QSpinBox::valueChanged), this, &DummyPanel::editWaves);
        return editor;
    }

protected:
    void paintEvent(QPaintEvent * /*event*/) override
    {
        QPainter painter(this);
        painter.fillRect(rect(), palette().color(QPalette::Base));
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(QColor::fromHsv(m_type * 47 % 360, 160, 190), 1.5));
        QPolygonF curve;
        for (int x = 0; x < width(); ++x)
            curve.append(QPointF(x, height() * (0.5 - 0.35 * std::sin(6.28 * m_waves * x / qMax(width(), 1)))));
        painter.drawPolyline(curve);
    }

private:
    int m_type;
    int m_waves = 2;
};

class DummyFactory : public QPlcWidgetFactory
{
public:
    DummyFactory(int type, const QString &name)
        : m_type(type)
        , m_name(name)
    {
    }
    int type() const override { return m_type; }
    QString name() const override { return m_name; }
    QPlcWidget *createNew(QWidget *parent) const override { return new DummyPanel(m_type, parent); }

private:
    int m_type;
    QString m_name;
};

/// Factories "Time plot", "Gauge" and "Value table".
class DummyFactories
{
public:
    DummyFactories()
    {
        for (const char *name : {"Time plot", "Gauge", "Value table"})
            m_owned.push_back(
                std::make_unique<DummyFactory>(QPlcWidget::UserType + int(m_owned.size()), QString::fromUtf8(name)));
    }
    QList<QPlcWidgetFactory *> all() const
    {
        QList<QPlcWidgetFactory *> factories;
        for (const auto &factory : m_owned)
            factories.append(factory.get());
        return factories;
    }

private:
    std::vector<std::unique_ptr<DummyFactory>> m_owned;
};
