// Elements, built in code: a page served with a strict policy has no inline handlers and styles.

type Child = Node | string | null;

export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string | boolean> = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) result.setAttribute(name, "");
    else if (value !== false) result.setAttribute(name, value);
  }
  for (const child of children) if (child !== null) result.append(child);
  return result;
}

export function byId<Type extends Element = HTMLElement>(id: string): Type {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page lacks the element "${id}"`);
  return found as unknown as Type;
}

export function button(label: string, onClick: () => void, attributes: Record<string, string | boolean> = {}) {
  const result = element("button", { type: "button", ...attributes }, label);
  result.addEventListener("click", onClick);
  return result;
}

/** A button that is on or off. */
export function toggle(label: string, onChange: (on: boolean) => void, attributes: Record<string, string> = {}) {
  const result = button(label, () => onChange(result.getAttribute("aria-pressed") !== "true"), {
    "aria-pressed": "false",
    ...attributes,
  });
  return result;
}

export function press(pressed: HTMLElement, on: boolean) {
  pressed.setAttribute("aria-pressed", String(on));
}

/** A labelled control in a row; the value stands to the right of the label. */
export function field(label: string, control: HTMLElement, value: HTMLElement | null = null) {
  const caption = element("span", { class: "caption" }, label);
  return element("label", { class: "field" }, element("span", { class: "head" }, caption, value), control);
}

export function section(title: string, ...children: Child[]) {
  return element("section", { class: "block" }, element("h2", {}, title), ...children);
}

export function select(options: [string, string][], onChange: (value: string) => void, label: string) {
  const result = element("select", { "aria-label": label });
  for (const [value, text] of options) result.append(element("option", { value }, text));
  result.addEventListener("change", () => onChange(result.value));
  return result;
}

export function range(low: number, high: number, step: number, value: number, label: string) {
  const attributes = { type: "range", min: `${low}`, max: `${high}`, step: `${step}`, "aria-label": label };
  const result = element("input", attributes);
  result.value = String(value);
  return result;
}
