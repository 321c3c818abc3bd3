// SPDX-License-Identifier: Apache-2.0
#include "JsonNames.h"

#include <algorithm>
#include <vector>

namespace qplc {

namespace {

bool isSpace(char character)
{
    return character == ' ' || character == '\t' || character == '\n' || character == '\r';
}

/// Reads the text of one string, from behind its opening quote.
class StringReader
{
public:
    StringReader(const QByteArray &json, int *place)
        : m_json(json)
        , m_place(*place)
    {
    }

    /// The bytes up to the closing quote, which is skipped.
    QString read()
    {
        const int begin = m_place;
        bool hasEscapes = false;
        while (m_place < m_json.size() && m_json.at(m_place) != '"') {
            const bool isEscape = m_json.at(m_place) == '\\';
            hasEscapes = hasEscapes || isEscape;
            m_place += isEscape ? 2 : 1;
        }
        const int end = std::min(m_place++, m_json.size());
        const QByteArray bytes = m_json.mid(begin, end - begin);
        return hasEscapes ? unescaped(bytes) : QString::fromUtf8(bytes);
    }

private:
    static QString unescaped(const QByteArray &bytes)
    {
        QString result;
        int from = 0;
        for (int escape = 0; (escape = bytes.indexOf('\\', from)) >= 0;) {
            result += QString::fromUtf8(bytes.mid(from, escape - from));
            const char code = escape + 1 < bytes.size() ? bytes.at(escape + 1) : '\0';
            if (code == 'u')
                result += QChar(bytes.mid(escape + 2, 4).toUShort(nullptr, 16));
            else
                result += character(code);
            from = escape + (code == 'u' ? 6 : 2);
        }
        return result + QString::fromUtf8(bytes.mid(from));
    }

    static QChar character(char code)
    {
        switch (code) {
        case 'b':
            return QLatin1Char('\b');
        case 'f':
            return QLatin1Char('\f');
        case 'n':
            return QLatin1Char('\n');
        case 'r':
            return QLatin1Char('\r');
        case 't':
            return QLatin1Char('\t');
        default:
            return QLatin1Char(code);  // also where JSON knows no such escape: so does Qt
        }
    }

    const QByteArray &m_json;
    int &m_place;
};

std::optional<QString> doubledOf(std::vector<QString> *names)
{
    std::sort(names->begin(), names->end());
    const auto found = std::adjacent_find(names->begin(), names->end());
    return found == names->end() ? std::nullopt : std::optional<QString>(*found);
}

}  // namespace

std::optional<QString> doubledJsonName(const QByteArray &json)
{
    std::vector<std::vector<QString>> open;  // names of the objects (arrays: none) around the place, the innermost last
    for (int place = 0; place < json.size();) {
        const char character = json.at(place++);
        if (character == '{' || character == '[') {
            open.emplace_back();
        } else if ((character == '}' || character == ']') && !open.empty()) {
            if (const std::optional<QString> doubled = doubledOf(&open.back()))
                return doubled;
            open.pop_back();
        } else if (character == '"') {
            const QString text = StringReader(json, &place).read();
            while (place < json.size() && isSpace(json.at(place)))
                ++place;
            if (place < json.size() && json.at(place) == ':' && !open.empty())
                open.back().push_back(text);
        }
    }
    return std::nullopt;
}

}  // namespace qplc
