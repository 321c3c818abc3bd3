// SPDX-License-Identifier: Apache-2.0
#include "GaugeEditor.h"

#include "gui/models/SiPrefix.h"
#include "gui/panel/SignalEdit.h"

#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QFormLayout>

namespace qplc {

GaugeEditor::GaugeEditor(const PanelSettings &settings, const QString &title, const QPlcSignalDefinition &definition,
                         QPlcPanelContext *context, QWidget *parent)
    : SettingsEditor(parent)
    , m_settings(settings)
{
    auto *form = new QFormLayout(this);
    addSignal(form, context);
    addStyles(form);
    auto *titleEdit = new QLineEdit(title, this);
    titleEdit->setPlaceholderText(tr("Gauge"));
    form->addRow(tr("Title"), titleEdit);
    connect(titleEdit, &QLineEdit::editingFinished, this, [this, titleEdit] { Q_EMIT titleEdited(titleEdit->text()); });
    addNumbers(form, definition);
    auto *extremes = new QCheckBox(tr("Smallest and largest value since reset"), this);
    extremes->setChecked(m_settings.value("extremes").toBool());
    form->addRow(extremes);
    connect(extremes, &QCheckBox::toggled, this, [this](bool isOn) { set("extremes", isOn, false); });
}

void GaugeEditor::addSignal(QFormLayout *form, QPlcPanelContext *context)
{
    auto *edit = new SignalEdit(context, SignalEdit::AllSignals, this);
    edit->setPlaceholderText(tr("Signal, or = formula"));
    edit->setText(m_settings.value("signal").toString());
    edit->setMinimumWidth(edit->fontMetrics().averageCharWidth() * 34);
    form->addRow(tr("Signal"), edit);
    setFocusProxy(edit);
    connect(edit, &SignalEdit::chosen, this, [this](const QString &name) { set("signal", name, QString()); });
    connect(edit, &QLineEdit::editingFinished, this,
            [this, edit] { set("signal", edit->text().trimmed(), QString()); });
}

void GaugeEditor::addStyles(QFormLayout *form)
{
    auto *styles = new QComboBox(this);
    styles->addItem(tr("Dial"), styleText(GaugeStyle::Dial));
    styles->addItem(tr("Bar"), styleText(GaugeStyle::Bar));
    styles->addItem(tr("Number"), styleText(GaugeStyle::Number));
    styles->addItem(tr("LED"), styleText(GaugeStyle::Led));
    styles->setCurrentIndex(styles->findData(styleText(GaugeSettings::from(m_settings).style)));
    form->addRow(tr("Style"), styles);
    connect(styles, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
            [this, styles] { set("style", styles->currentData().toString(), styleText(GaugeStyle::Dial)); });
}

void GaugeEditor::addNumbers(QFormLayout *form, const QPlcSignalDefinition &definition)
{
    const auto ofTable = [](const QPlcValue &limit, const QString &otherwise) {
        return limit.isValid() ? tr("%1 (of the table)").arg(limit.toString()) : otherwise;
    };
    // What a person types is in the unit of the table, and says so: a prefix would make 4 out of
    // 4000 while it is typed.
    const QString unit = SiPrefix::unitText(definition.unit);
    const auto named
        = [&unit](const QString &label) { return unit.isEmpty() ? label : QStringLiteral("%1 [%2]").arg(label, unit); };
    addLimit(form, named(tr("Scale from")), "minimum", ofTable(definition.minimum, tr("automatic")));
    addLimit(form, named(tr("Scale to")), "maximum", ofTable(definition.maximum, tr("automatic")));
    addLimit(form, named(tr("Alarm below")), "alarmLow", ofTable(definition.minimum, tr("none")));
    addLimit(form, named(tr("Warning below")), "warningLow", tr("none"));
    addLimit(form, named(tr("Warning above")), "warningHigh", tr("none"));
    addLimit(form, named(tr("Alarm above")), "alarmHigh", ofTable(definition.maximum, tr("none")));
    addLimit(form, named(tr("Hysteresis")), "hysteresis", tr("1 % of the scale"));
}

void GaugeEditor::addLimit(QFormLayout *form, const QString &label, const char *key, const QString &whenEmpty)
{
    const QJsonValue value = m_settings.value(key);
    const std::optional<double> number = value.isDouble() ? std::optional<double>(value.toDouble()) : std::nullopt;
    QLineEdit *line = addNumber(form, label, number, whenEmpty, [this, key](std::optional<double> wanted) {
        set(key, wanted ? QJsonValue(*wanted) : QJsonValue());
    });
    line->setObjectName(QLatin1String(key));
}

void GaugeEditor::set(const char *key, const QJsonValue &value, const QJsonValue &defaultValue)
{
    if (m_settings.set(key, value, defaultValue))
        Q_EMIT edited(m_settings);
}

}  // namespace qplc
