// What scripts of the page get from others: texts and knobs from the program, a site its data and the module, and the viewer itself.
declare const TEXTS: any;
declare const TOLD: any;
declare const KNOBS: any[];
declare const LIMITS: any;
declare const SITE: any;
declare const LESSONS: any[];
declare const MODULE: string;
declare const WORKER: string;
declare const wasm_bindgen: any;

// What the page gives to a console and to tests.
interface Window { asperity: any; }
