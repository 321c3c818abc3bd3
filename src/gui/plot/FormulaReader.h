// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Formula.h"

namespace qplc {

/// Takes the text of a formula apart: signals become operands, functions with a past become parts,
/// the rest is for muParser.
class FormulaReader
{
public:
    /// Where the text is no formula, and why.
    struct Error
    {
        int place;
        QString what;
    };

    FormulaReader(const QString &text, const QStringList &plants);

    /// \throw Error
    void read();
    const QVector<Formula::Operand> &operands() const { return m_operands; }
    const std::vector<Formula::Part> &parts() const { return m_parts; }

private:
    using Part = Formula::Part;
    enum End { EndOfText, EndOfArgument };

    Part readExpression(End end);
    bool readParenthesis(QVector<int> *opened, End end, Part *part);
    bool readOperator(Part *part);
    bool readNumber(Part *part);
    bool readName(Part *part);
    void readSignal(Part *part);
    void readCall(const QString &name, int place, Part *part);
    void readNorm(int place, Part *part);
    double readTime(const QString &function);
    void expect(QChar character, const QString &what);
    void skipBlanks();
    int plantPrefix() const;
    QString match(const char *pattern) const;
    QChar peek() const { return m_at < m_text.size() ? m_text.at(m_at) : QChar(); }

    QString m_text;
    QStringList m_plants;
    int m_at = 0;
    QVector<Formula::Operand> m_operands;
    std::vector<Part> m_parts;
};

}  // namespace qplc
