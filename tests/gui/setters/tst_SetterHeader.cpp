// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcSetter.h"
#include "gui/setters/ElidedLabel.h"

using namespace qplc;

/// The line of a setter that says which signal it sets, and the value that the signal has.
class tst_SetterHeader : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theNameHasTheRoomThatTheValueLeaves();
};

void tst_SetterHeader::theNameHasTheRoomThatTheValueLeaves()
{
    QPlcSetter setter;
    setter.applySettings({{"signal", "bodyControlPitchSpeed"}, {"style", "slider"}});
    ElidedLabel *name = nullptr;
    for (ElidedLabel *label : setter.findChildren<ElidedLabel *>()) {
        if (label->text() == QLatin1String("bodyControlPitchSpeed"))
            name = label;
    }
    QVERIFY(name);
    constexpr int besides = 100;  // [px] margins, and the few characters of a value
    setter.resize(name->fontMetrics().horizontalAdvance(name->text()) + besides, 120);
    setter.show();
    QVERIFY(QTest::qWaitForWindowExposed(&setter));
    QVERIFY2(!name->isElided(), qPrintable(QString::number(name->width())));
}

QTEST_MAIN(tst_SetterHeader)
#include "tst_SetterHeader.moc"
