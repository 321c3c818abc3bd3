// SPDX-License-Identifier: Apache-2.0
#include "TwoPlants.h"

#include <QtWidgets/QSlider>

#include <random>

using namespace qplc;

namespace {

const QString echo = QStringLiteral("echo");
const QString setpoint = QStringLiteral("setpoint");
constexpr int stepsOfSession = 25;

/// A person who does anything at all with a window of two plants. After each deed it is known which
/// plants the window named where it was done.
class Person
{
public:
    Person(TwoPlants *fixture, unsigned seed)
        : m_fixture(*fixture)
        , m_random(seed)
        , m_number(fixture->addSetter(setpoint, QStringLiteral("number")))
        , m_keyboard(fixture->addKeyboard())
    {
        m_setters << m_number << fixture->addSetter(setpoint, QStringLiteral("momentary"))
                  << fixture->addSetter(setpoint, QStringLiteral("slider"))
                  << fixture->addSetter(echo, QStringLiteral("slider"), QStringLiteral("south"))
                  << fixture->addSetter(QStringLiteral("north/echo"), QStringLiteral("number"))
                  << fixture->addSetter(echo, QStringLiteral("momentary"));
    }

    /// \return what was done; empty: it was not possible now
    QString act()
    {
        m_named.clear();
        switch (roll(14)) {
        case 0:
        case 1:
            return select();
        case 2:
            return takeControl();
        case 3:
            return giveBack();
        case 4:
            return giveAllBack();
        case 5:
            return type();
        case 6:
            return hold();
        case 7:
            return slide();
        case 8:
            return steer();
        case 9:
            return stop();
        case 10:
            return stopByKeys();
        case 11:
            return answer();
        case 12:
            return next();
        default:
            return pin();
        }
    }
    const QStringList &named() const { return m_named; }

private:
    int roll(int sides) { return int(m_random() % unsigned(sides)); }
    QPlcSetter *anySetter() { return m_setters.at(roll(m_setters.size())); }
    static bool isUsable(const QWidget *widget) { return widget && widget->isVisible() && widget->isEnabled(); }

    /// What was begun and not ended yet ends in the plants for which it was begun.
    void nameHeld()
    {
        m_named << m_held;
        const auto isPressed = [](const QPlcSetter *setter) {
            const QList<QAbstractButton *> buttons = setter->findChildren<QAbstractButton *>();
            const auto *slider = setter->findChild<QSlider *>();
            return (slider && slider->isSliderDown())
                || std::any_of(buttons.begin(), buttons.end(), [](const auto *button) { return button->isDown(); });
        };
        if (std::none_of(m_setters.begin(), m_setters.end(), isPressed))
            m_held.clear();
    }
    QString select()
    {
        m_named << m_fixture.barPlant();
        nameHeld();
        if (roll(2) == 0) {
            m_fixture.selectNext();
            return QStringLiteral("next plant");
        }
        QTest::mouseClick(m_fixture.topBar()->selector(), Qt::LeftButton);
        auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
        if (!menu)
            return {};
        TwoPlants::choose(menu, roll(2) == 0 ? QStringLiteral("north") : QStringLiteral("south"));
        return QStringLiteral("choose a plant");
    }
    QString takeControl()
    {
        QPlcWidget *panel = roll(2) == 0 ? static_cast<QPlcWidget *>(m_keyboard) : anySetter();
        m_named << TwoPlants::plantsOf(panel);
        nameHeld();
        return TwoPlants::take(panel) ? QStringLiteral("take control") : QString();
    }
    QString giveBack()
    {
        QPlcWidget *panel = roll(2) == 0 ? static_cast<QPlcWidget *>(m_keyboard) : anySetter();
        QAbstractButton *button = buttonOf(panel, QStringLiteral("Give back"));
        m_named << TwoPlants::plantsOf(panel);
        nameHeld();
        if (button)
            QTest::mouseClick(button, Qt::LeftButton);
        return button ? QStringLiteral("give back") : QString();
    }
    QString giveAllBack()
    {
        ControlNotice *notice = m_fixture.topBar()->controlNotice();
        const QString said = notice->lines().join(QLatin1Char(' '));
        for (const char *name : {"north", "south"}) {
            if (said.contains(QLatin1String(name) + QStringLiteral("/")))
                m_named << QString::fromLatin1(name);
        }
        nameHeld();
        if (!isUsable(notice->giveBackButton()))
            return {};
        QTest::mouseClick(notice->giveBackButton(), Qt::LeftButton);
        return QStringLiteral("give all back");
    }
    QString type()
    {
        auto *setter = m_setters.at(roll(2) == 0 ? 0 : 4);
        auto *field = setter->findChild<QLineEdit *>();
        if (!isUsable(field) || field->isReadOnly())
            return {};
        m_named << TwoPlants::plantsOf(setter);
        nameHeld();
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, QString::number(roll(9)));
        if (roll(3) == 0)
            return QStringLiteral("type without Enter");
        QTest::keyClick(field, Qt::Key_Return);
        return QStringLiteral("type");
    }
    QString hold()
    {
        QPlcSetter *setter = m_setters.at(roll(2) == 0 ? 1 : 5);
        auto *button = qobject_cast<QAbstractButton *>(setter->focusProxy()->focusProxy());
        if (!isUsable(button))
            return {};
        nameHeld();
        if (button->isDown()) {
            m_named << m_begunOf.value(setter);  // what was begun for one plant does not end in another one
            QTest::mouseRelease(button, Qt::LeftButton);
            return QStringLiteral("release");
        }
        m_named << TwoPlants::plantsOf(setter);
        m_begunOf[setter] = m_named;
        m_held << TwoPlants::plantsOf(setter);
        button->setFocus();
        QTest::mousePress(button, Qt::LeftButton);
        return QStringLiteral("press");
    }
    QString slide()
    {
        QPlcSetter *setter = m_setters.at(roll(2) == 0 ? 2 : 3);
        auto *slider = setter->findChild<QSlider *>();
        if (!isUsable(slider))
            return {};
        nameHeld();
        const QPoint place(roll(slider->width()), slider->height() / 2);
        if (slider->isSliderDown()) {
            m_named << m_begunOf.value(setter);
            m_held << m_begunOf.value(setter);
            QTest::mouseMove(slider, place);
            return QStringLiteral("drag");
        }
        m_named << TwoPlants::plantsOf(setter);
        m_begunOf[setter] = TwoPlants::plantsOf(setter);
        m_held << TwoPlants::plantsOf(setter);  // a value may wait for its turn
        slider->setFocus();
        QTest::mousePress(slider, Qt::LeftButton, {}, QPoint(slider->width() / 2, slider->height() / 2));
        for (int key = roll(4); key > 0; --key)
            QTest::keyClick(slider, Qt::Key_Right);
        if (roll(2) == 0)
            QTest::mouseRelease(slider, Qt::LeftButton, {}, place);
        return QStringLiteral("slide");
    }
    QString steer()
    {
        nameHeld();
        m_keyboard->setFocus();
        if (roll(3) == 0) {
            m_named << m_begunOf.value(m_keyboard);
            QTest::keyRelease(m_keyboard, Qt::Key_W);
            return QStringLiteral("let the key go");
        }
        m_named << TwoPlants::plantsOf(m_keyboard);
        m_begunOf[m_keyboard] = TwoPlants::plantsOf(m_keyboard);
        m_held << TwoPlants::plantsOf(m_keyboard);
        QTest::keyPress(m_keyboard, Qt::Key_W);
        return QStringLiteral("hold the key");
    }
    QString stop()
    {
        if (roll(3) != 0)
            return {};  // else nothing runs for most of the time
        m_named << m_fixture.stopPlants();
        nameHeld();
        QTest::mouseClick(m_fixture.topBar()->stopButton(), Qt::LeftButton);
        return QStringLiteral("STOP");
    }
    QString stopByKeys()
    {
        if (roll(3) != 0)
            return {};
        m_named << m_fixture.stopPlants();
        nameHeld();
        m_fixture.press(Qt::Key_Escape);
        m_fixture.press(Qt::Key_Escape);
        return QStringLiteral("Esc Esc");
    }
    QString answer()
    {
        auto *question = m_fixture.part<StopQuestion>();
        for (const char *choice : {"Stop north", "Stop south", "Stop none"}) {
            QAbstractButton *button = buttonOf(question, QString::fromLatin1(choice));
            if (!button || roll(2) == 0)
                continue;
            m_named << QString::fromLatin1(choice).mid(5);
            nameHeld();
            QTest::mouseClick(button, Qt::LeftButton);
            return QString::fromLatin1(choice);
        }
        return {};
    }
    QString next()
    {
        m_named << m_fixture.barPlant();
        nameHeld();
        BarButton *button = m_fixture.topBar()->nextButton();
        if (isUsable(button) && roll(2) == 0) {
            if (!button->toolTip().endsWith(m_fixture.barPlant()))
                m_named.clear();
            QTest::mouseClick(button, Qt::LeftButton);
            return QStringLiteral("next step");
        }
        m_fixture.press(Qt::Key_F5);
        return QStringLiteral("F5");
    }
    QString pin()
    {
        QPlcWidget *panel = roll(2) == 0 ? static_cast<QPlcWidget *>(m_keyboard) : m_setters.at(roll(3));
        m_named << TwoPlants::plantsOf(panel);
        nameHeld();
        PanelTitleBar *title = TwoPlants::frameOf(panel)->titleBar();
        QTest::mouseClick(title, Qt::LeftButton, {}, title->badgeRect().center());
        auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
        if (!menu)
            return {};
        constexpr const char *choices[] = {"The one", "Pin to north", "Pin to south"};
        TwoPlants::choose(menu, QString::fromLatin1(choices[roll(3)]));
        return QStringLiteral("pin");
    }

    TwoPlants &m_fixture;
    std::mt19937 m_random;
    QPlcSetter *m_number;
    QPlcKeyboardControl *m_keyboard;
    QVector<QPlcSetter *> m_setters;
    QStringList m_named;
    QHash<QPlcWidget *, QStringList> m_begunOf;  // the plants for which a person has pressed something there
    QStringList m_held;                          // by the mouse, by keys, or for the next turn of a slider
};

QString textOf(const CommandTap &tap)
{
    QStringList texts;
    for (const QPlcMessage &message : tap.commands())
        texts << message.kindName() + QString::fromUtf8(QJsonDocument(message.fields()).toJson(QJsonDocument::Compact));
    return texts.join(QLatin1Char(' '));
}

}  // namespace

/// Two plants, and a person who clicks at random: what arrives at a master is what the window said.
class tst_PlantClicks : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void noCommandReachesAPlantThatTheWindowDoesNotName_data();
    void noCommandReachesAPlantThatTheWindowDoesNotName();
    void randomSessionsSendEveryKindOfCommand();

private:
    std::unique_ptr<TestSettings> m_settings;
    QMap<QPlcMessage::Kind, int> m_kinds;
};

void tst_PlantClicks::noCommandReachesAPlantThatTheWindowDoesNotName_data()
{
    QTest::addColumn<unsigned>("seed");
    for (unsigned seed = 1; seed <= 20; ++seed)
        QTest::newRow(qPrintable(QStringLiteral("session %1").arg(seed))) << seed;
}

void tst_PlantClicks::noCommandReachesAPlantThatTheWindowDoesNotName()
{
    QFETCH(unsigned, seed);
    TwoPlants fixture;
    Person person(&fixture, seed);
    QVERIFY(fixture.isReady());
    fixture.clear();
    QStringList deeds;
    for (int step = 0; step < stepsOfSession; ++step) {
        QString deed;
        while (deed.isEmpty()) {  // not all is possible at any time
            deed = person.act();
            if (QWidget *popup = QApplication::activePopupWidget())
                popup->close();
        }
        deeds << deed;
        QVERIFY2(fixture.settle(), qPrintable(deeds.join(QStringLiteral(", "))));
        const QVector<QPair<const CommandTap *, QString>> all{{&fixture.northTap, QStringLiteral("north")},
                                                              {&fixture.southTap, QStringLiteral("south")}};
        for (const auto &[tap, name] : all) {
            QVERIFY2(tap->commands().isEmpty() || person.named().contains(name),
                     qPrintable(QStringLiteral("%1 got %2 while the window named %3; deeds: %4")
                                    .arg(name, textOf(*tap), person.named().join(QStringLiteral(", ")),
                                         deeds.join(QStringLiteral(", ")))));
            for (const QPlcMessage &message : tap->commands())
                ++m_kinds[message.kind()];
        }
        fixture.clear();
    }
}

void tst_PlantClicks::randomSessionsSendEveryKindOfCommand()
{
    for (const auto kind : {QPlcMessage::SetSignals, QPlcMessage::TakeLease, QPlcMessage::ReleaseLease,
                            QPlcMessage::Stop, QPlcMessage::StartRealTime})
        QVERIFY2(m_kinds.value(kind) >= 5,
                 qPrintable(QStringLiteral("%1: %2").arg(QPlcMessage::kindName(kind)).arg(m_kinds.value(kind))));
}

QTEST_MAIN(tst_PlantClicks)
#include "tst_PlantClicks.moc"
