// SPDX-License-Identifier: Apache-2.0
#include "FormulaReader.h"

#include "FormulaCalculator.h"

#include <QtCore/QRegularExpression>

#include <algorithm>

namespace qplc {

namespace {

const char *const namePattern = "[\\p{L}_][\\p{L}\\p{N}_.]{0,62}";
const char *const numberPattern = "(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][+-]?[0-9]+)?";
const char *const operatorPattern = "<=|>=|==|!=|&&|\\|\\||[-+*/^<>?:]";

struct PastFunction
{
    const char *name;
    Formula::Function function;
    bool hasTime;
};

constexpr PastFunction pastFunctions[] = {{"derivative", Formula::Derivative, false},
                                          {"integral", Formula::Integral, false},
                                          {"mean", Formula::Mean, true},
                                          {"lowpass", Formula::LowPass, true}};

const PastFunction *pastFunction(const QString &name)
{
    for (const PastFunction &each : pastFunctions) {
        if (name == QLatin1String(each.name))
            return &each;
    }
    return nullptr;
}

void append(Formula::Part *part, const std::string &text, int place)
{
    part->text += text;
    part->places.insert(part->places.end(), text.size(), place);
}

void append(Formula::Part *part, const Formula::Part &other)
{
    part->text += other.text;
    part->places.insert(part->places.end(), other.places.begin(), other.places.end());
}

/// A value, not to grow together with its neighbours.
void appendValue(Formula::Part *part, const std::string &text, int place)
{
    append(part, " " + text + " ", place);
}

/// The number of the operand that is all of a part; -1: it is something else.
int soleOperand(const Formula::Part &part)
{
    const QString text = QString::fromStdString(part.text).trimmed();
    bool isNumber = false;
    const int number = text.mid(1).toInt(&isNumber);
    return isNumber && text.startsWith(QLatin1Char('s')) ? number : -1;
}

class FormulaReader
{
public:
    FormulaReader(const QString &text, const QStringList &plants)
        : m_text(text)
        , m_plants(plants)
    {
    }

    /// \throw FormulaError
    FormulaText read()
    {
        skipBlanks();
        expect(QLatin1Char('='), QStringLiteral("a formula begins with '='"));
        m_parts.push_back(readExpression(EndOfText));
        return {m_operands, m_parts};
    }

private:
    using Part = Formula::Part;
    enum End { EndOfText, EndOfArgument };

    Part readExpression(End end)
    {
        Part part;
        QVector<int> opened;
        for (skipBlanks(); m_at < m_text.size(); skipBlanks()) {
            const QChar next = peek();
            if (end == EndOfArgument && opened.isEmpty() && (next == QLatin1Char(',') || next == QLatin1Char(')')))
                break;
            const bool isRead
                = readParenthesis(&opened, end, &part) || readName(&part) || readNumber(&part) || readOperator(&part);
            if (!isRead)
                throw FormulaError{m_at, QStringLiteral("'%1' has no meaning in a formula").arg(next)};
        }
        if (!opened.isEmpty())
            throw FormulaError{opened.last(), QStringLiteral("this parenthesis is not closed")};
        part.end = m_at;
        return part;
    }

    bool readParenthesis(QVector<int> *opened, End end, Part *part)
    {
        const QChar next = peek();
        if (next == QLatin1Char('(')) {
            opened->append(m_at);
        } else if (next == QLatin1Char(')')) {
            if (opened->isEmpty())
                throw FormulaError{m_at, QStringLiteral("no parenthesis is open that could be closed here")};
            opened->removeLast();
        } else if (next == QLatin1Char(',')) {
            if (opened->isEmpty() && end == EndOfText)
                throw FormulaError{
                    m_at, QStringLiteral("a comma stands between arguments of a function only; decimals have a point")};
        } else {
            return false;
        }
        append(part, std::string(1, next.toLatin1()), m_at++);
        return true;
    }

    bool readOperator(Part *part)
    {
        const QString text = match(operatorPattern);
        append(part, text.toStdString(), m_at);
        m_at += text.size();
        return !text.isEmpty();
    }

    bool readNumber(Part *part)
    {
        const QString text = match(numberPattern);
        if (text.isEmpty())
            return false;
        appendValue(part, text.toStdString(), m_at);
        m_at += text.size();
        return true;
    }

    bool readName(Part *part)
    {
        if (plantPrefix() > 0) {
            readSignal(part);
            return true;
        }
        const int place = m_at;
        const QString name = match(namePattern);
        if (name.isEmpty())
            return false;
        m_at += name.size();
        skipBlanks();
        if (peek() == QLatin1Char('(')) {
            readCall(name, place, part);
        } else if (name == QLatin1String("_pi") || name == QLatin1String("_e")) {
            appendValue(part, name.toStdString(), place);
        } else {
            m_at = place;
            readSignal(part);
        }
        return true;
    }

    void readSignal(Part *part)
    {
        const int place = m_at;
        m_at += plantPrefix();
        m_at += match(namePattern).size();
        m_at += match("\\[[0-9]{1,4}\\]").size();
        QString error;
        const SignalReference reference = SignalReference::fromString(m_text.mid(place, m_at - place), &error);
        if (!reference.isValid())
            throw FormulaError{place, error};
        appendValue(part, "s" + std::to_string(m_operands.size()), place);
        m_operands.append({reference, place, false});
    }

    void readCall(const QString &name, int place, Part *part)
    {
        const PastFunction *past = pastFunction(name);
        if (!past && name != QLatin1String("norm")) {
            if (!FormulaCalculator::functions().contains(name))
                throw FormulaError{
                    place,
                    QStringLiteral("there is no function '%1'; there are derivative, integral, mean, lowpass, norm, %2")
                        .arg(name, FormulaCalculator::functions().join(QLatin1String(", ")))};
            append(part, " " + name.toStdString(), place);
            return;
        }
        ++m_at;
        if (!past) {
            readNorm(place, part);
            return;
        }
        Part argument = readExpression(EndOfArgument);
        argument.function = past->function;
        if (past->hasTime)
            argument.seconds = readTime(name);
        expect(QLatin1Char(')'), QStringLiteral("%1() ends here, ')' is missing").arg(name));
        m_parts.push_back(argument);
        appendValue(part, "f" + std::to_string(m_parts.size() - 1), place);
    }

    void readNorm(int place, Part *part)
    {
        Part sum;
        int arguments = 0;
        int operand = -1;
        for (QChar next = QLatin1Char(','); next == QLatin1Char(','); ++m_at, ++arguments) {
            const Part argument = readExpression(EndOfArgument);
            next = peek();
            if (argument.text.empty())
                throw FormulaError{m_at, QStringLiteral("a value is missing")};
            if (next.isNull())
                throw FormulaError{m_at, QStringLiteral("norm() ends here, ')' is missing")};
            operand = soleOperand(argument);
            if (operand >= 0)
                m_operands[operand].isNorm = true;
            append(&sum, arguments == 0 ? "(" : "+(", place);
            append(&sum, argument);
            append(&sum, ")^2", m_at);
        }
        if (arguments == 1 && operand >= 0) {
            appendValue(part, "s" + std::to_string(operand), place);
            return;
        }
        append(part, " sqrt(", place);
        append(part, sum);
        append(part, ")", m_at - 1);
    }

    double readTime(const QString &function)
    {
        expect(QLatin1Char(','), QStringLiteral("%1() needs a time in seconds: %1(x, 5)").arg(function));
        skipBlanks();
        const int place = m_at;
        const QString text = match(numberPattern);
        const double seconds = text.toDouble();
        if (!(seconds > 0.0 && seconds <= Formula::longestTime))
            throw FormulaError{place,
                               QStringLiteral("the time of %1() is a number of seconds, above 0 and at most %2")
                                   .arg(function)
                                   .arg(Formula::longestTime)};
        m_at += text.size();
        return seconds;
    }

    void expect(QChar character, const QString &what)
    {
        skipBlanks();
        if (peek() != character)
            throw FormulaError{m_at, what};
        ++m_at;
    }

    void skipBlanks()
    {
        while (peek().isSpace())
            ++m_at;
    }

    /// The length of the name of a plant with "/", if one stands here before a signal; else 0.
    int plantPrefix() const
    {
        static const QRegularExpression signalBegin(QStringLiteral("^/[\\p{L}_]"));
        int longest = 0;
        for (const QString &plant : m_plants) {
            const bool isHere = m_text.midRef(m_at).startsWith(plant)
                && signalBegin.match(m_text.mid(m_at + plant.size(), 2)).hasMatch();
            if (isHere && !plant.isEmpty())
                longest = std::max(longest, plant.size() + 1);
        }
        return longest;
    }

    /// What stands here and is of this form.
    QString match(const char *pattern) const
    {
        const QRegularExpression expression(QString::fromLatin1(pattern));
        return expression.match(m_text, m_at, QRegularExpression::NormalMatch, QRegularExpression::AnchoredMatchOption)
            .captured();
    }

    QChar peek() const { return m_at < m_text.size() ? m_text.at(m_at) : QChar(); }

    QString m_text;
    QStringList m_plants;
    int m_at = 0;
    QVector<Formula::Operand> m_operands;
    std::vector<Part> m_parts;
};

}  // namespace

FormulaText readFormula(const QString &text, const QStringList &plants)
{
    return FormulaReader(text, plants).read();
}

}  // namespace qplc
