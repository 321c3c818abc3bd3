// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "gui/models/ValueFormat.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QHBoxLayout>

#include <cmath>

namespace qplc {

namespace {

/// Neither a wheel nor a letter chooses: a plant is no form that is filled in.
class CarefulList : public QComboBox
{
public:
    using QComboBox::QComboBox;

protected:
    void wheelEvent(QWheelEvent *event) override { event->ignore(); }
    void keyPressEvent(QKeyEvent *event) override
    {
        switch (event->key()) {
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_Space:
        case Qt::Key_Return:
        case Qt::Key_Enter:
            showPopup();
            break;
        default:
            event->ignore();
        }
    }
};

/// A list of the names that the values of a signal have in its table: what is chosen is sent once,
/// as its number. Keys open the list, so that nothing is sent on the way.
class ChoiceView : public SetterView
{
public:
    ChoiceView(SetterTarget *target, QWidget *parent)
        : SetterView(target, parent)
        , m_list(new CarefulList(this))
    {
        auto *row = new QHBoxLayout(this);
        row->setContentsMargins(0, 0, 0, 0);
        row->addWidget(m_list);
        m_list->setAccessibleName(tr("New value"));
        setFocusProxy(m_list);
        connect(m_list, QOverload<int>::of(&QComboBox::activated), this, &ChoiceView::choose);
        refresh();
    }

    void refresh() override
    {
        fill();
        m_list->setEnabled(target().control().mayWrite() && target().isNumber() && m_list->count() > 0);
        if (target().signal() && m_names.isEmpty())
            Q_EMIT said(
                tr("The values of '%1' have no names: give it 'values = 0: Off, 1: On' in the table, or this setter "
                   "another style")
                    .arg(target().reference()));
        showActual();
    }

    void showActual() override
    {
        if (m_waits > 0)
            --m_waits;
        if (m_waits > 0 || m_list->view()->isVisible())
            return;
        const double actual = target().actualNumber();
        m_list->setPlaceholderText(std::isnan(actual) ? QString() : numberText(actual));
        m_list->setCurrentIndex(m_list->findData(actual));
    }

private:
    void fill()
    {
        const QPlcValueNames names = target().signal() ? target().signal().definition.valueNames : QPlcValueNames();
        if (names == m_names && target().minimum() == m_minimum && target().maximum() == m_maximum)
            return;
        m_names = names;
        m_minimum = target().minimum();
        m_maximum = target().maximum();
        m_list->clear();
        for (const QPlcValueNames::Entry &entry : m_names) {
            const auto value = double(entry.value);
            if (target().clamped(value) == value)
                m_list->addItem(entry.name, value);
        }
    }

    void choose(int place)
    {
        m_waits = 4;
        target().sendOnce(m_list->itemData(place).toDouble());
    }

    QComboBox *m_list;
    QPlcValueNames m_names;
    std::optional<double> m_minimum;  // of what is in the list
    std::optional<double> m_maximum;
    int m_waits = 0;  // looks at the actual value until what was chosen is there
};

}  // namespace

SetterView *createChoiceView(SetterTarget *target, QWidget *parent)
{
    return new ChoiceView(target, parent);
}

}  // namespace qplc
