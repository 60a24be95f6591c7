#include "bindings/values.h"

#include <fmt/format.h>

#include "stilb/error.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

std::string text_of(nb::handle text) { return nb::str(text).c_str(); }

std::int64_t integer_of(nb::handle number, const std::string& path) {
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    if (overflow != 0)
        throw InputError(fmt::format("{}: the number {} is too large.", path, text_of(number)));
    return value;
}

Value list_of(nb::handle sequence, const std::string& path) {
    Value::List list;
    for (const nb::handle element : sequence)
        list.push_back(value_of(element, fmt::format("{}[{}]", path, list.size())));
    return list;
}

/// The value of a number or an array of NumPy. tolist() makes them numbers of Python, but for the widest
/// (longdouble), which becomes a double here.
Value numpy_value_of(nb::handle value, const std::string& path) {
    const nb::object plain = value.attr("tolist")();
    if (!plain.type().is(value.type())) return value_of(plain, path);
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred()) throw nb::python_error();
    return number;
}

}  // namespace

Value value_of(nb::handle value, const std::string& path) {
    if (PyBool_Check(value.ptr())) return value.is(Py_True);
    if (PyLong_Check(value.ptr())) return integer_of(value, path);
    if (PyFloat_Check(value.ptr())) return PyFloat_AS_DOUBLE(value.ptr());
    if (PyUnicode_Check(value.ptr())) return text_of(value);
    if (PyDict_Check(value.ptr())) return parameters_of(nb::borrow<nb::dict>(value), path);
    if (nb::hasattr(value, "tolist")) return numpy_value_of(value, path);
    if (nb::hasattr(value, "__fspath__")) return text_of(value.attr("__fspath__")());
    if (PySequence_Check(value.ptr())) return list_of(value, path);
    throw InputError(
        fmt::format("{}: a value of type {} is not allowed. Allowed: numbers, texts, True and False, lists "
                    "and dictionaries.",
                    path, text_of(value.type().attr("__name__"))));
}

Parameters parameters_of(const nb::dict& keys, const std::string& path) {
    Parameters parameters;
    for (const auto& [key, value] : keys) {
        const std::string name = text_of(key);
        parameters.insert_or_assign(name, value_of(value, path + "." + name));
    }
    return parameters;
}

}  // namespace stilb::api::bindings
