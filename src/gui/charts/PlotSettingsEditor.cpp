// SPDX-License-Identifier: Apache-2.0
#include "PlotSettingsEditor.h"

#include "QPlcPanelContext.h"
#include "gui/panel/SignalEdit.h"

#include <QtGui/QPainter>
#include <QtGui/QRegularExpressionValidator>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>
#include <QtWidgets/QWidgetAction>

namespace qplc {

namespace {

constexpr int colorSize = 14;   // [px]
constexpr int themeColors = 8;  // of the theme
constexpr int numberChars = 9;  // that are seen
constexpr int editedDigits = 10;
constexpr int leastSignalChars = 24;
constexpr int leastNameChars = 12;

QIcon colorIcon(const QColor &color, double scale)
{
    QPixmap pixmap(QSize(colorSize, colorSize) * scale);
    pixmap.setDevicePixelRatio(scale);
    pixmap.fill(color);
    return pixmap;
}

int widthOf(const QWidget *widget, int characters)
{
    return characters * widget->fontMetrics().horizontalAdvance(QLatin1Char('8'));
}

QLabel *heading(const QString &text, QWidget *parent)
{
    auto *label = new QLabel(text, parent);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

}  // namespace

PlotSettingsEditor::PlotSettingsEditor(const PlotSettings &settings, const QStringList &furtherUnits,
                                       QPlcPanelContext *context, QWidget *parent)
    : SettingsEditor(parent)
    , m_settings(settings)
    , m_theme(context->theme())
{
    auto *column = new QVBoxLayout(this);
    m_curves = new QWidget(this);
    column->addWidget(m_curves);
    auto *add = new SignalEdit(context, SignalEdit::Curves, this);
    add->setPlaceholderText(tr("Add a signal, or = formula, and press Enter"));
    add->setObjectName(QStringLiteral("add"));
    connect(add, &SignalEdit::chosen, this, [this, add](const QString &name) {
        add->clear();
        PlotCurveSettings curve;
        curve.signal = name;
        m_settings.curves.append(curve);
        makeCurves();
        tell();
    });
    column->addWidget(add);
    setFocusProxy(add);
    column->addWidget(makeOptions(furtherUnits));
    makeCurves();
}

void PlotSettingsEditor::makeCurves()
{
    // Lines are made anew within a signal of one of them: the old ones end later.
    if (m_grid) {
        QWidget *old = m_curves;
        m_curves = new QWidget(this);
        delete layout()->replaceWidget(old, m_curves);  // the item that held it
        old->hide();
        old->deleteLater();
    }
    m_grid = new QGridLayout(m_curves);
    m_grid->setContentsMargins(0, 0, 0, 0);
    m_grid->setVerticalSpacing(2);
    m_curves->setVisible(!m_settings.curves.isEmpty());
    const QStringList titles{QString(),    tr("Signal"), tr("Name"), tr("Gain"),
                             tr("Offset"), tr("Axis"),   tr("Seen"), QString()};
    for (int i = 0; i < titles.size(); ++i)
        m_grid->addWidget(heading(titles[i], m_curves), 0, i);
    m_grid->setColumnStretch(1, 1);
    for (int place = 0; place < m_settings.curves.size(); ++place)
        addLine(place);
    if (window()->isVisible() && window() != this)
        window()->adjustSize();
}

void PlotSettingsEditor::addLine(int place)
{
    const PlotCurveSettings &curve = m_settings.curves[place];
    QLineEdit *signal
        = makeText(tr("Signal of curve %1").arg(place + 1), curve.signal, [this, place](const QString &text) {
              if (text.isEmpty())
                  return;
              m_settings.curves[place].signal = text;
              tell();
          });
    signal->setMinimumWidth(widthOf(signal, leastSignalChars));
    QLineEdit *name = makeText(tr("Name of curve %1").arg(place + 1), curve.name, [this, place](const QString &text) {
        m_settings.curves[place].name = text;
        tell();
    });
    name->setMinimumWidth(widthOf(name, leastNameChars));
    name->setPlaceholderText(tr("as it is"));  // the signal is shown
    auto *axis = new QComboBox(m_curves);
    axis->addItems({tr("By unit"), tr("Left"), tr("Right")});
    axis->setCurrentIndex(!curve.axis ? 0 : *curve.axis == PlotCurveSettings::Left ? 1 : 2);
    axis->setAccessibleName(tr("Axis of %1").arg(curve.signal));
    connect(axis, QOverload<int>::of(&QComboBox::activated), this, [this, place](int index) {
        PlotCurveSettings changed = m_settings.curves.at(place);
        changed.axis.reset();
        if (index > 0)
            changed.axis = index == 1 ? PlotCurveSettings::Left : PlotCurveSettings::Right;
        m_settings.curves.replace(place, changed);
        tell();
    });
    auto *seen = new QCheckBox(m_curves);
    seen->setChecked(curve.isVisible);
    seen->setAccessibleName(tr("%1 is seen").arg(curve.signal));
    connect(seen, &QCheckBox::toggled, this, [this, place](bool isOn) {
        m_settings.curves[place].isVisible = isOn;
        tell();
    });
    auto *remove = new QToolButton(m_curves);
    remove->setText(QStringLiteral("×"));
    remove->setAutoRaise(true);
    remove->setToolTip(tr("Remove this curve"));
    remove->setAccessibleName(tr("Remove %1").arg(curve.signal));
    connect(remove, &QToolButton::clicked, this, [this, place] { removeCurve(place); });
    const int row = place + 1;
    m_grid->addWidget(makeColorButton(place), row, 0);
    m_grid->addWidget(signal, row, 1);
    m_grid->addWidget(name, row, 2);
    m_grid->addWidget(makeScale(tr("Gain of %1").arg(curve.signal), &PlotCurveSettings::gain, place), row, 3);
    m_grid->addWidget(makeScale(tr("Offset of %1").arg(curve.signal), &PlotCurveSettings::offset, place), row, 4);
    m_grid->addWidget(axis, row, 5);
    m_grid->addWidget(seen, row, 6, Qt::AlignCenter);
    m_grid->addWidget(remove, row, 7);
}

void PlotSettingsEditor::tell()
{
    m_limits->setChecked(m_settings.showsLimits());
    Q_EMIT edited(m_settings);
}

void PlotSettingsEditor::removeCurve(int place)
{
    m_settings.curves.removeAt(place);
    makeCurves();
    tell();
}

QLineEdit *PlotSettingsEditor::makeScale(const QString &name, double PlotCurveSettings::*member, int place)
{
    QLineEdit *edit
        = makeNumber(name, m_settings.curves[place].*member, {}, [this, member, place](std::optional<double> number) {
              m_settings.curves[place].*member = *number;
              tell();
          });
    edit->setMaximumWidth(widthOf(edit, numberChars) + 12);
    return edit;
}

void PlotSettingsEditor::paintColor(QToolButton *button, int place) const
{
    const QColor &own = m_settings.curves[place].color;
    button->setIcon(colorIcon(own.isValid() ? own : m_theme.curve(place), devicePixelRatioF()));
}

/// A menu of the colours of the theme, and a line for any other one: a dialog would close the popup
/// that the editor is in.
QToolButton *PlotSettingsEditor::makeColorButton(int place)
{
    auto *button = new QToolButton(m_curves);
    button->setAutoRaise(true);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setToolTip(tr("Colour of the curve"));
    button->setAccessibleName(tr("Colour of %1").arg(m_settings.curves[place].signal));
    paintColor(button, place);
    auto *menu = new QMenu(button);
    const auto set = [this, button, place](const QColor &color) {
        m_settings.curves[place].color = color;
        paintColor(button, place);
        tell();
    };
    menu->addAction(colorIcon(m_theme.curve(place), devicePixelRatioF()), tr("By place"), this, [set] { set({}); });
    menu->addSeparator();
    for (int i = 0; i < themeColors; ++i) {
        const QColor color = m_theme.curve(i);
        menu->addAction(colorIcon(color, devicePixelRatioF()), color.name(), this, [set, color] { set(color); });
    }
    auto *other = new QLineEdit(menu);
    other->setPlaceholderText(tr("#rrggbb"));
    other->setAccessibleName(tr("Another colour"));
    static const QRegularExpression form(QStringLiteral("#[0-9a-fA-F]{6}"));
    other->setValidator(new QRegularExpressionValidator(form, other));
    connect(other, &QLineEdit::returnPressed, menu, [set, other, menu] {
        set(QColor(other->text()));
        menu->close();
    });
    auto *line = new QWidgetAction(menu);
    line->setDefaultWidget(other);
    menu->addAction(line);
    button->setMenu(menu);
    return button;
}

QWidget *PlotSettingsEditor::makeOptions(const QStringList &furtherUnits)
{
    auto *options = new QWidget(this);
    auto *form = new QFormLayout(options);
    form->setContentsMargins(0, 6, 0, 0);
    const auto addRange = [&](const QString &title, const Range &range) {
        auto *line = new QHBoxLayout;
        line->addWidget(makeEnd(tr("%1: smallest value").arg(title), range, &PlotRangeSettings::minimum));
        line->addWidget(new QLabel(QStringLiteral("…"), options));
        line->addWidget(makeEnd(tr("%1: largest value").arg(title), range, &PlotRangeSettings::maximum));
        line->addWidget(new QLabel(tr("lines"), options));
        line->addWidget(makeLines(tr("%1: reference lines").arg(title), range));
        form->addRow(title, line);
    };
    addRange(tr("Left axis"), {0, {}});
    addRange(tr("Right axis"), {1, {}});
    for (const QString &unit : furtherUnits)
        addRange(unit.isEmpty() ? tr("Axis without unit") : tr("Axis of %1").arg(unit), {2, unit});
    form->addRow(tr("Time axis"), makeTimeAxis());
    auto *checks = new QHBoxLayout;
    checks->addWidget(makeCheck(tr("Grid"), &PlotSettings::hasGrid));
    checks->addWidget(makeLimits());
    checks->addWidget(makeCheck(tr("Legend"), &PlotSettings::hasLegend));
    checks->addWidget(makeCheck(tr("Statistics"), &PlotSettings::hasStatistics));
    checks->addStretch();
    form->addRow(tr("Show"), checks);
    return options;
}

QLineEdit *PlotSettingsEditor::makeEnd(const QString &name, const Range &range,
                                       std::optional<double> PlotRangeSettings::*end)
{
    return makeNumber(name, settingsOf(range).*end, tr("automatic"), [this, range, end](std::optional<double> number) {
        settingsOf(range).*end = number;
        tell();
    });
}

/// Values with spaces between them.
QLineEdit *PlotSettingsEditor::makeLines(const QString &name, const Range &range)
{
    auto *edit = new QLineEdit(this);
    QStringList texts;
    for (const double line : qAsConst(settingsOf(range).lines))
        texts << QString::number(line, 'g', editedDigits);
    edit->setText(texts.join(QLatin1Char(' ')));
    edit->setPlaceholderText(tr("4000 4500"));
    edit->setAccessibleName(name);
    connect(edit, &QLineEdit::textEdited, this, [this, range](const QString &text) {
        QVector<double> lines;
        const QStringList parts = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
        for (const QString &part : parts) {
            bool isNumber = false;
            lines.append(part.toDouble(&isNumber));
            if (!isNumber)
                return;  // not finished
        }
        settingsOf(range).lines = lines;
        tell();
    });
    return edit;
}

QCheckBox *PlotSettingsEditor::makeCheck(const QString &text, bool PlotSettings::*member)
{
    auto *check = new QCheckBox(text, this);
    check->setChecked(m_settings.*member);
    connect(check, &QCheckBox::toggled, this, [this, member](bool isOn) {
        m_settings.*member = isOn;
        tell();
    });
    return check;
}

QCheckBox *PlotSettingsEditor::makeLimits()
{
    m_limits = new QCheckBox(tr("Limits"), this);
    m_limits->setToolTip(tr("Lines at the limits of the signal table"));
    m_limits->setChecked(m_settings.showsLimits());
    connect(m_limits, &QCheckBox::clicked, this, [this](bool isOn) {
        m_settings.limits = isOn;
        tell();
    });
    return m_limits;
}

QWidget *PlotSettingsEditor::makeTimeAxis()
{
    auto *options = new QWidget(this);
    auto *line = new QHBoxLayout(options);
    line->setContentsMargins(0, 0, 0, 0);
    auto *own = new QComboBox(options);
    own->addItems({tr("That of the window"), tr("Its own")});
    own->setCurrentIndex(m_settings.hasOwnTime ? 1 : 0);
    own->setAccessibleName(tr("Time axis"));
    QLineEdit *span
        = makeNumber(tr("Seconds of an own time axis"), m_settings.span, {}, [this](std::optional<double> seconds) {
              if (*seconds <= 0.0)
                  return;
              m_settings.span = *seconds;
              tell();
          });
    span->setMaximumWidth(widthOf(span, numberChars));
    span->setEnabled(m_settings.hasOwnTime);
    auto *labels = new QComboBox(options);
    labels->addItems({tr("Time of day"), tr("Seconds")});
    labels->setCurrentIndex(m_settings.labels == PlotSettings::Labels::Clock ? 0 : 1);
    labels->setAccessibleName(tr("Labels of the time axis"));
    connect(own, QOverload<int>::of(&QComboBox::activated), this, [this, span](int index) {
        m_settings.hasOwnTime = index == 1;
        span->setEnabled(m_settings.hasOwnTime);
        tell();
    });
    connect(labels, QOverload<int>::of(&QComboBox::activated), this, [this](int index) {
        m_settings.labels = index == 0 ? PlotSettings::Labels::Clock : PlotSettings::Labels::Seconds;
        tell();
    });
    line->addWidget(own);
    line->addWidget(span);
    line->addWidget(new QLabel(tr("s"), options));
    line->addWidget(labels);
    line->addStretch();
    return options;
}

}  // namespace qplc
