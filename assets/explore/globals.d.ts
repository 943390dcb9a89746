// What scripts of the page get from others: texts and knobs from the program, a site its data and the module, and the viewer itself.
declare const LANGUAGES: Record<string, string>;
declare const ENGLISH: string;
declare const FOREIGN: string;
declare const KNOBS: any[];
declare const LIMITS: any;
declare const SITE: any;
declare const FIRST_SECTION: string;
declare const LESSONS: string;
declare const MODULE: string;
declare const WORKER: string;
declare const wasm_bindgen: any;

// What the page gives to a console and to tests.
interface Window { asperity: any; }
