// SPDX-License-Identifier: Apache-2.0
#include "formulas/FormulaCalculator.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;
using Values = std::vector<double>;

namespace {

constexpr FormulaCalculator::Time s = 1'000'000'000;
const double none = std::numeric_limits<double>::quiet_NaN();

/// The results for rows of a single signal, so many seconds apart.
Values resultsOf(const QString &text, const Values &rows, double pause = 1.0)
{
    const Formula formula = Formula::read(text, {});
    FormulaCalculator calculator(formula);
    Values results;
    FormulaCalculator::Time time = 0;
    for (const double row : rows) {
        const Values operands(std::size_t(formula.operands().size()), row);
        results.push_back(calculator.next(time += std::llround(pause * 1e9), operands.data()));
    }
    return results;
}

bool areSame(const Values &a, const Values &b)
{
    const auto isSame = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), isSame);
}

}  // namespace

class tst_Formula : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void formulasGiveTheExpectedResults_data();
    void formulasGiveTheExpectedResults();
    void signalsAreFoundInFormulas();
    void plantNamesTakePrecedenceOverDivision();
    void syntaxErrorIsReportedWithItsPosition_data();
    void syntaxErrorIsReportedWithItsPosition();
    void unitsFollowFunctions_data();
    void unitsFollowFunctions();
    void theDerivativeOfALineIsItsSlope();
    void derivativeOfAParabolaIsExactAtTheMidpoint();
    void theIntegralOfALineIsExact();
    void theDerivativeOfTheIntegralIsTheMeanOfNeighbours();
    void theLowPassAnswersAStepAsTheExponentialFunction();
    void theLowPassDoesNotDependOnTheRate();
    void meanCoversTheRowsOfItsTimeWindow();
    void theMeanOfAWholePeriodIsZero();
    void aLargeValueLeavesNoTraceInTheMean();
    void theNormOfSeveralArgumentsIsTheRootOfTheirSquares();
    void nestedFunctionsAreCalculatedFromTheInside();
    void interruptionRestartsEveryFunction();
    void cyclesThatWereLostAreAsNaN();
    void nanInIsNanOut();
    void undefinedResultsGiveNoValue();
};

void tst_Formula::formulasGiveTheExpectedResults_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<double>("result");  // for x = 3
    QTest::newRow("signal") << "=x" << 3.0;
    QTest::newRow("blanks") << "  =   x " << 3.0;
    QTest::newRow("numbers") << "= x/1000 + 2*abs(-x) + .5e1" << 11.003;
    QTest::newRow("precedence") << "= 2 + x*x^2 - -1" << 30.0;
    QTest::newRow("parentheses") << "= ((x + 1)) * (2 - x)" << -4.0;
    QTest::newRow("choice") << "= x > 2 && x != 4 ? 10 : 20" << 10.0;
    QTest::newRow("many arguments") << "= max(1, x, 2) + min(x, 1)" << 4.0;
    QTest::newRow("constants") << "= cos(_pi)" << -1.0;
    QTest::newRow("names with an e") << "= x + 1e1 + 2e0" << 15.0;
}

void tst_Formula::formulasGiveTheExpectedResults()
{
    QFETCH(QString, text);
    QString error;
    QVERIFY2(Formula::read(text, {}, &error).isValid(), qPrintable(error));
    QVERIFY(error.isEmpty());
    QTEST(resultsOf(text, {3.0}).front(), "result");
}

void tst_Formula::signalsAreFoundInFormulas()
{
    const Formula formula = Formula::read(QStringLiteral("= a.b_c[2] + mean(\u00fcber.1, 5) - norm(v) + a.b_c[2]"), {});
    QVERIFY(formula.isValid());
    QStringList names;
    for (const Formula::Operand &operand : formula.operands())
        names << operand.reference.toString();
    QCOMPARE(names, (QStringList{"a.b_c[2]", "\u00fcber.1", "v", "a.b_c[2]"}));
    QCOMPARE(formula.operands().at(1).place, 18);
    QVERIFY(formula.operands().at(2).isNorm);
    QVERIFY(!formula.operands().at(0).isNorm);
}

void tst_Formula::plantNamesTakePrecedenceOverDivision()
{
    const QStringList plants{"east", "127.0.0.1:5000", "a"};
    const auto referencesOf = [&](const QString &text) {
        QStringList names;
        const Formula formula = Formula::read(text, plants);
        for (const Formula::Operand &operand : formula.operands())
            names << operand.reference.toString();
        return names;
    };
    QCOMPARE(referencesOf("= east/power/2"), QStringList{"east/power"});
    QCOMPARE(referencesOf("= 2*127.0.0.1:5000/power[1]"), QStringList{"127.0.0.1:5000/power[1]"});
    QCOMPARE(referencesOf("= west/power"), (QStringList{"west", "power"}));
    QCOMPARE(referencesOf("= east / power"), (QStringList{"east", "power"}));
    QCOMPARE(referencesOf("= a/1000"), QStringList{"a"});
    QCOMPARE(referencesOf("= abs(a/b)"), QStringList{"a/b"});
}

void tst_Formula::syntaxErrorIsReportedWithItsPosition_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("what");
    QTest::addColumn<QString>("where");
    const auto row
        = [](const char *text, const char *what, const char *where) { QTest::newRow(text) << text << what << where; };
    row("power", "begins with '='", "at character 1 ");
    row("= power +", "a value is missing", "at the end");
    row("=", "a value is missing", "at the end");
    row("= derivative()", "a value is missing", "at character 14 ");
    row("= derivative(2*)+1", "a value is missing", "at character 16 ");
    row("= a b", "an operator is missing", "at character 5 ");
    row("= 2 3", "an operator is missing", "at character 5 ");
    row("= a ** 2", "an operator stands", "at character 6 ");
    row("= (a + 1", "not closed", "at character 3 ");
    row("= a + 1)", "no parenthesis is open", "at character 8 ");
    row("= foo(a)", "no function 'foo'", "at character 3 ");
    row("= a = 3", "'=' has no meaning", "at character 5 ");
    row("= a; 3", "';' has no meaning", "at character 4 ");
    row("= \"a\"", "has no meaning", "at character 3 ");
    row("= 1,5 * a", "a comma stands", "at character 4 ");
    row("= mean(a)", "mean() needs a time", "at character 9 ");
    row("= mean(a, 0)", "above 0", "at character 11 ");
    row("= mean(a, -1)", "above 0", "at character 11 ");
    row("= mean(a, b)", "above 0", "at character 11 ");
    row("= lowpass(a, 1e9)", "at most 600", "at character 14 ");
    row("= lowpass(a, 1, 2)", "')' is missing", "at character 15 ");
    row("= derivative(a, 2)", "')' is missing", "at character 15 ");
    row("= derivative(a", "')' is missing", "at the end");
    row("= norm(a", "')' is missing", "at the end");
    row("= norm()", "a value is missing", "at character 8 ");
    row("= norm(a,)", "a value is missing", "at character 10 ");
    row("= sqrt()", "", "");
    row("= sqrt(a, 2)", "too many arguments", "");
    row("= a ? 1", "':' is missing", "");
    row("= a[b]", "'[' has no meaning", "at character 4 ");
    row("= a[99999]", "'[' has no meaning", "at character 4 ");
    row("= .", "'.' has no meaning", "at character 3 ");
}

void tst_Formula::syntaxErrorIsReportedWithItsPosition()
{
    QFETCH(QString, text);
    QFETCH(QString, what);
    QFETCH(QString, where);
    QString error;
    QVERIFY(!Formula::read(text, {}, &error).isValid());
    QVERIFY2(error.contains(what) && error.contains(where) && error.contains(text), qPrintable(error));
    QVERIFY(!Formula::read(QString(2000, 'a').prepend('='), {}, &error).isValid());
    QVERIFY2(error.contains("at most 1000"), qPrintable(error));
}

void tst_Formula::unitsFollowFunctions_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("unit");
    QTest::addColumn<QString>("result");
    QTest::newRow("signal") << "= a"
                            << "m"
                            << "m";
    QTest::newRow("derivative") << "= derivative(a)"
                                << "m"
                                << "m/s";
    QTest::newRow("second derivative") << "= derivative(derivative(a))"
                                       << "m" << QStringLiteral("m/s\u00b2");
    QTest::newRow("derivative of a number") << "= derivative(a)"
                                            << ""
                                            << "1/s";
    QTest::newRow("integral") << "= integral(a)"
                              << "W"
                              << "W s";
    QTest::newRow("integral of a speed") << "= integral(a)"
                                         << "m/s"
                                         << "m";
    QTest::newRow("and back") << "= derivative(integral(a))"
                              << "W"
                              << "W";
    QTest::newRow("mean") << "= mean(a, 5)"
                          << "W"
                          << "W";
    QTest::newRow("low-pass of a derivative") << "= lowpass(derivative(a), 2)"
                                              << "W"
                                              << "W/s";
    QTest::newRow("norm") << "= norm(a)"
                          << "m"
                          << "m";
    QTest::newRow("formula") << "= 2*a"
                             << "m"
                             << "";
    QTest::newRow("derivative of a formula") << "= derivative(2*a)"
                                             << "m"
                                             << "";
    QTest::newRow("number") << "= 2"
                            << "m"
                            << "";
}

void tst_Formula::unitsFollowFunctions()
{
    QFETCH(QString, text);
    QFETCH(QString, unit);
    QTEST(Formula::read(text, {}).unit({unit}), "result");
}

void tst_Formula::theDerivativeOfALineIsItsSlope()
{
    QVERIFY(areSame(resultsOf("= derivative(x)", {1, 1.5, 2, 2.5}, 0.25), {none, 2, 2, 2}));
}

void tst_Formula::derivativeOfAParabolaIsExactAtTheMidpoint()
{
    QVERIFY(areSame(resultsOf("= derivative(x^2)", {0, 1, 2, 3}), {none, 1, 3, 5}));
}

void tst_Formula::theIntegralOfALineIsExact()
{
    QVERIFY(areSame(resultsOf("= integral(x)", {0, 2, 4, 6}, 0.5), {0, 0.5, 2, 4.5}));
}

void tst_Formula::theDerivativeOfTheIntegralIsTheMeanOfNeighbours()
{
    QVERIFY(areSame(resultsOf("= derivative(integral(x))", {1, 3, 7, -1}, 0.5), {none, 2, 5, 3}));
}

void tst_Formula::theLowPassAnswersAStepAsTheExponentialFunction()
{
    Values step(1000, 1.0);
    step.front() = 0.0;
    const Values results = resultsOf("= lowpass(x, 2)", step, 0.01);
    for (std::size_t row = 0; row < step.size(); ++row)
        QVERIFY(std::fabs(results[row] - (1.0 - std::exp(-0.01 * double(row) / 2.0))) < 1e-12);
}

void tst_Formula::theLowPassDoesNotDependOnTheRate()
{
    Values coarse(11, 1.0);
    Values fine(1001, 1.0);
    coarse.front() = fine.front() = 0.0;
    const double atOnce = resultsOf("= lowpass(x, 2)", coarse, 0.1).back();
    QVERIFY(std::fabs(atOnce - resultsOf("= lowpass(x, 2)", fine, 0.001).back()) < 1e-12);
}

void tst_Formula::meanCoversTheRowsOfItsTimeWindow()
{
    QVERIFY(areSame(resultsOf("= mean(x, 3)", {3, 6, 9, 12, 0}), {3, 4.5, 6, 9, 7}));
    QVERIFY(areSame(resultsOf("= mean(x, 0.5)", {3, 6, 9}), {3, 6, 9}));
}

void tst_Formula::theMeanOfAWholePeriodIsZero()
{
    Values wave;
    for (int row = 0; row < 1000; ++row)
        wave.push_back(std::sin(row * 2.0 * M_PI / 100.0));
    const Values results = resultsOf("= mean(x, 1)", wave, 0.01);
    for (std::size_t row = 99; row < results.size(); ++row)
        QVERIFY(std::fabs(results[row]) < 1e-12);
}

void tst_Formula::aLargeValueLeavesNoTraceInTheMean()
{
    Values rows(100, 0.001);
    rows[3] = 1e20;
    QVERIFY(std::fabs(resultsOf("= mean(x, 10)", rows).back() - 0.001) < 1e-9);
}

void tst_Formula::theNormOfSeveralArgumentsIsTheRootOfTheirSquares()
{
    QCOMPARE(resultsOf("= norm(x - 7, 3)", {3}).front(), 5.0);
    QCOMPARE(resultsOf("= 1 + norm(2*x) / 2", {-2}).front(), 3.0);
}

void tst_Formula::nestedFunctionsAreCalculatedFromTheInside()
{
    QVERIFY(areSame(resultsOf("= 10*mean(derivative(2*x) + 1, 2)", {0, 1, 2, 4}), {none, 30, 30, 40}));
}

void tst_Formula::interruptionRestartsEveryFunction()
{
    const QStringList texts{"= derivative(x)", "= integral(x)", "= mean(x, 5)", "= lowpass(x, 5)"};
    for (const QString &text : texts) {
        FormulaCalculator calculator(Formula::read(text, {}));
        Values first;
        Values second;
        const Values rows{1, 5, -2};
        for (std::size_t i = 0; i < rows.size(); ++i)
            first.push_back(calculator.next(FormulaCalculator::Time(i) * s, &rows[i]));
        calculator.interrupt();
        for (std::size_t i = 0; i < rows.size(); ++i)
            second.push_back(calculator.next(FormulaCalculator::Time(100 + i) * s, &rows[i]));
        QVERIFY2(areSame(first, second), qPrintable(text));
    }
}

/// An integral that began at 0 after each lost cycle would be none on a computer that loses one now
/// and then.
void tst_Formula::cyclesThatWereLostAreAsNaN()
{
    constexpr FormulaCalculator::Time ms = 1'000'000;
    const QStringList texts{"= derivative(x)", "= integral(x)", "= mean(x, 5)", "= lowpass(x, 5)",
                            "= integral(mean(x, 5))"};
    for (const QString &text : texts) {
        FormulaCalculator withLoss(Formula::read(text, {}));
        FormulaCalculator withNaN(Formula::read(text, {}));
        const Values rows{1, 5, -2, 4};
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (i == 2) {
                withLoss.interrupt();
                withNaN.next(15 * ms, &none);
            }
            const auto time = FormulaCalculator::Time(i * (i < 2 ? 10 : 100)) * ms;
            QVERIFY2(areSame({withLoss.next(time, &rows[i])}, {withNaN.next(time, &rows[i])}), qPrintable(text));
        }
    }
    FormulaCalculator integral(Formula::read("= integral(x)", {}));
    const double one = 1.0;
    for (int i = 0; i <= 100; ++i)
        integral.next(i * 10 * ms, &one);
    integral.interrupt();
    QCOMPARE(integral.next(1500 * ms, &one), 1.0);
    integral.interrupt();
    QCOMPARE(integral.next(2001 * ms, &one), 0.0);
}

void tst_Formula::nanInIsNanOut()
{
    QVERIFY(areSame(resultsOf("= 0*x + 1", {1, none, 1}), {1, none, 1}));
    QVERIFY(areSame(resultsOf("= derivative(x)", {1, none, 3, 4}), {none, none, none, 1}));
    QVERIFY(areSame(resultsOf("= integral(x)", {1, 1, none, 1, 1}), {0, 1, none, 1, 2}));
    QVERIFY(areSame(resultsOf("= mean(x, 3)", {1, none, 3, 5}), {1, none, 2, 4}));
    QVERIFY(
        areSame(resultsOf("= lowpass(x, 3)", {1, 7, none, 3}), {1, resultsOf("= lowpass(x, 3)", {1, 7})[1], none, 3}));
}

void tst_Formula::undefinedResultsGiveNoValue()
{
    QVERIFY(areSame(resultsOf("= 1/x", {0, 2}), {none, 0.5}));
    QVERIFY(areSame(resultsOf("= sqrt(x)", {-1, 4}), {none, 2}));
    QVERIFY(areSame(resultsOf("= integral(1/x)", {1, 0, 1, 1}), {0, none, 0, 1}));
}

QTEST_GUILESS_MAIN(tst_Formula)
#include "tst_Formula.moc"
